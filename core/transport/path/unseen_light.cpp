// SPDX-License-Identifier: BSD-2-Clause
#include "core/transport/path/unseen_light.h"

#include "core/scene/scene.h"
#include "core/transport/specular/caustic_lights.h"
#include "core/transport/specular/specular_boxes.h"

namespace exphoton {

std::vector<std::string> UnseenByPaths(const Scene& scene) {
  // With --effects all, the plan has caustics in scenes without mirrors and glass too.
  if (!scene.Features().Needs(Feature::Caustics) || SpecularBoxes(scene).Boxes().empty()) return {};
  const CausticLights caustics(scene);
  int count = 0;
  for (std::size_t i = 0; i < scene.Lights().size(); ++i) {
    const Light& light = *scene.Lights()[i];
    count += light.IsDelta() && !light.IsProvablyBlack() && !caustics.IsOutOfReach(int(i));
  }
  if (count == 0) return {};
  if (count == 1) return {"caustics of a light without a size"};
  return {"caustics of " + std::to_string(count) + " lights without a size"};
}

}  // namespace exphoton
