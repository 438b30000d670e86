// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/shooting/emission/caustic_lights.h"

#include <algorithm>

#include "core/lights/emission_cone.h"
#include "core/math/half_space.h"

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

}  // namespace

CausticLights::CausticLights(const Scene& scene) {
  if (IsAskedForAll(scene)) return;
  const SpecularBoxes specular(scene);
  if (specular.Boxes().empty()) return;
  for (const std::unique_ptr<Light>& light : scene.Lights()) {
    const bool isOut = std::ranges::none_of(
        specular.Boxes(), [&](const Bounds3& box) { return MayReach(*light, box); });
    isOutOfReach_.push_back(isOut);
    if (light->IsProvablyBlack()) continue;
    ++shining_;
    outOfReach_ += isOut;
  }
}

}  // namespace exphoton
