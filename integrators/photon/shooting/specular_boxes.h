// SPDX-License-Identifier: BSD-2-Clause
// SpecularBoxes: a few boxes that hold every specular surface of a scene. A photon that passes them
// all by cannot make a caustic, because its path would have to begin with a specular surface. Not
// an accelerator: a ray that meets a box may still miss the surface.
#pragma once

#include <vector>

#include "core/math/bounds.h"
#include "core/scene/scene.h"

namespace exphoton {

class SpecularBoxes {
 public:
  // Boxes of parts of the surfaces; more hold them closer and take longer to test.
  static constexpr int kMostBoxes = 16;

  SpecularBoxes() = default;  // none: every ray passes by
  explicit SpecularBoxes(const Scene& scene);

  // Whether the ray certainly misses all specular surfaces at all times of the exposure.
  bool PassesBy(const Ray& ray) const;

  const std::vector<Bounds3>& Boxes() const { return boxes_; }

 private:
  Bounds3 all_;
  std::vector<Bounds3> boxes_;
};

}  // namespace exphoton
