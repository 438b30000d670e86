// SPDX-License-Identifier: BSD-2-Clause
#include "core/transport/specular/caustic_lights.h"

#include <algorithm>

#include "core/lights/emission_cone.h"

namespace exphoton {
namespace {

bool IsAskedForAll(const Scene& scene) {
  static const RequiredFeatures all;
  return scene.Features().Get(Feature::Caustics).reason == all.Get(Feature::Caustics).reason;
}

// Returns false only if no ray that the light emits hits the box.
bool MayReach(const Light& light, const Bounds3& box) {
  if (const auto* const cone = dynamic_cast<const ConeEmitter*>(&light))
    return cone->Cone().MayHit(box);
  const auto* const side = dynamic_cast<const OneSided*>(&light);
  return !side || side->MayFace(box);
}

// Returns the bounds of any specular surface. They are empty if there is none.
Bounds3 FindSpecularSurface(const PrimitiveSet& primitives) {
  for (std::uint32_t id = 0; id < primitives.Count(); ++id)
    if (Intersects(primitives.PossibleLobes(id), LobeSet::Specular) &&
        !primitives.Bounds(id).IsEmpty())
      return primitives.Bounds(id);
  return {};
}

}  // namespace

CausticLights::CausticLights(const Scene& scene) {
  const auto& lights = scene.Lights();
  // If all lights reach one surface, the boxes of all surfaces are not needed.
  const Bounds3 surface = FindSpecularSurface(scene.Primitives());
  const auto reachesIt = [&](const auto& light) { return MayReach(*light, surface); };
  if (IsAskedForAll(scene) || surface.IsEmpty() || std::ranges::all_of(lights, reachesIt)) return;
  const SpecularBoxes specular(scene);
  for (const std::unique_ptr<Light>& light : lights) {
    const bool isOut = std::ranges::none_of(
        specular.Boxes(), [&](const Bounds3& box) { return MayReach(*light, box); });
    isOutOfReach_.push_back(isOut);
    if (light->IsProvablyBlack()) continue;
    ++shining_;
    outOfReach_ += isOut;
  }
}

}  // namespace exphoton
