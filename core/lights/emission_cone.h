// SPDX-License-Identifier: BSD-2-Clause
// EmissionCone bounds the rays that leave a light at a point. Lights that know such a cone
// implement ConeEmitter beside Light. Lights that emit on one side of a surface implement OneSided.
// Both prove that a light cannot reach an object.
#pragma once

#include "core/math/bounds.h"

namespace exphoton {

struct EmissionCone {
  Point3 apex;
  Vector3 axis;      // unit
  double angle = 0;  // half-angle in radians, 0 to pi

  // Returns false only if no ray of the cone hits the box. The answer allows for rounded
  // directions, so a cone that just misses may count as one that hits.
  bool MayHit(const Bounds3& box) const;
};

class ConeEmitter {
 public:
  virtual ~ConeEmitter() = default;
  // Returns a cone that contains every ray of Light::SampleEmission.
  virtual EmissionCone Cone() const = 0;
};

class OneSided {
 public:
  virtual ~OneSided() = default;
  // Returns false only if no ray of Light::SampleEmission hits the box, at any time.
  virtual bool MayFace(const Bounds3& box) const = 0;
};

}  // namespace exphoton
