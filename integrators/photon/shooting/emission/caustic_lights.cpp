// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/shooting/emission/caustic_lights.h"

#include <algorithm>

#include "core/lights/emission_cone.h"

namespace exphoton {
namespace {

bool IsAskedForAll(const Scene& scene) {
  static const RequiredFeatures all;
  return scene.Features().Get(Feature::Caustics).reason == all.Get(Feature::Caustics).reason;
}

}  // namespace

CausticLights::CausticLights(const Scene& scene) {
  const auto coneOf = [](const std::unique_ptr<Light>& light) {
    return dynamic_cast<const ConeEmitter*>(light.get());
  };
  const auto& lights = scene.Lights();
  if (IsAskedForAll(scene) || std::ranges::none_of(lights, coneOf)) return;
  const SpecularBoxes specular(scene);
  for (const std::unique_ptr<Light>& light : lights) {
    const ConeEmitter* const emitter = coneOf(light);
    const bool isOut = emitter && std::ranges::none_of(specular.Boxes(), [&](const Bounds3& box) {
                         return emitter->Cone().MayHit(box);
                       });
    isOutOfReach_.push_back(isOut);
    if (light->IsProvablyBlack()) continue;
    ++shining_;
    outOfReach_ += isOut;
  }
}

}  // namespace exphoton
