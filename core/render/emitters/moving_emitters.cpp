// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitters finds the emitters that move, and their bounds.
#include "core/render/emitters/moving_emitters.h"

#include <algorithm>

namespace exphoton {

MovingEmitters::MovingEmitters(const Scene& scene, const Camera& camera, std::optional<int> depth)
    : depth_(depth.value_or(0)), shutter_(camera.Shutter()) {
  const bool isOn = depth && scene.Features().Needs(Feature::Motion);
  if (isOn && !camera.MovesWithin(shutter_)) bounds_ = scene.Primitives().MovingEmitters(shutter_);
}

bool MovingEmitters::MayMeet(const Ray& ray) const {
  return std::any_of(bounds_.begin(), bounds_.end(), [&](const Bounds3& box) {
    return IntersectBox(box, ray.o, ray.d, ray.tMax).has_value();
  });
}

}  // namespace exphoton
