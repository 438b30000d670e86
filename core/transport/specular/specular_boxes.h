// SPDX-License-Identifier: BSD-2-Clause
// SpecularBoxes bounds all specular surfaces of a scene by a few boxes. A photon whose first ray
// misses all boxes cannot make a caustic, because a caustic path hits a specular surface first. The
// test is conservative: a ray that hits a box may still miss the surface.
#pragma once

#include <vector>

#include "core/math/bounds.h"
#include "core/scene/scene.h"

namespace exphoton {

class SpecularBoxes {
 public:
  // More boxes bound the surfaces more tightly, but take longer to test.
  static constexpr int kMaxBoxes = 16;

  SpecularBoxes() = default;  // no boxes: every ray misses
  explicit SpecularBoxes(const Scene& scene);

  // Returns true only if the ray misses all boxes. The boxes cover moving surfaces over the whole
  // shutter interval.
  bool Misses(const Ray& ray) const;

  const std::vector<Bounds3>& Boxes() const { return boxes_; }

 private:
  Bounds3 all_;
  std::vector<Bounds3> boxes_;
};

}  // namespace exphoton
