// SPDX-License-Identifier: BSD-2-Clause
// MovingEmitters: a specular tree whose surfaces have no light but the light of moving emitters.
#include "core/render/moving_emitters.h"

#include <algorithm>

#include "core/transport/specular/specular_tree.h"

namespace exphoton {

MovingEmitters::MovingEmitters(const Scene& scene, const Camera& camera, std::optional<int> depth)
    : depth_(depth.value_or(0)), shutter_(camera.Shutter()) {
  const bool isOn = depth && scene.Features().Needs(Feature::Motion) && !scene.HasMedia();
  if (isOn && !camera.MovesWithin(shutter_)) bounds_ = scene.Primitives().MovingEmitters(shutter_);
}

bool MovingEmitters::MayMeet(const Ray& ray) const {
  return std::any_of(bounds_.begin(), bounds_.end(), [&](const Bounds3& box) {
    return IntersectBox(box, ray.o, ray.d, ray.tMax).has_value();
  });
}

class MovingEmitters::Shade {
 public:
  Shade(const MovingEmitters& emitters, EmittedLight* light) : emitters_(emitters), light_(light) {}

  void See(const Ray& ray) const { light_->isNear = light_->isNear || emitters_.MayMeet(ray); }
  // The emission of the first surface is kept apart.
  Spectrum operator()(const ShadingPoint& point) const {
    const Motion* const motion = point.surface.motion;
    if (!motion || !motion->MovesWithin(emitters_.shutter_)) return {};
    if (point.depth > 0) return point.Le();
    light_->first = point.Le();
    return {};
  }

 private:
  const MovingEmitters& emitters_;
  EmittedLight* light_;
};

EmittedLight MovingEmitters::Along(const RayDifferential& ray, const LiContext& sample,
                                   RayCounters* rays) const {
  RayCounters counters;  // the light that depth limits cut was measured for the sample itself
  LiContext context{sample.scene, sample.samples, sample.arena, counters, sample.key};
  const Arena::Mark mark = context.arena.GetMark();
  EmittedLight light;
  light.specular = SpecularTree(depth_, context).Radiance(ray, Shade(*this, &light));
  context.arena.Rewind(mark);
  for (std::size_t i = 0; i < counters.counts.size(); ++i) rays->counts[i] += counters.counts[i];
  return light;
}

}  // namespace exphoton
