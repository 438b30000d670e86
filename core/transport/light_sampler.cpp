// SPDX-License-Identifier: BSD-2-Clause
// LightSampler: the number of lights decides between power sampling and the light tree.
#include "core/transport/light_sampler.h"

namespace exphoton {
namespace {

constexpr double kUniformShare = 0.5;
// With fewer lights, the light tree's better choices do not repay the time of its traversal.
constexpr int kManyLights = 16;

}  // namespace

LightSampler::LightSampler(const Scene& scene)
    : lights_(scene.Lights(), LightSelection::Power, kUniformShare) {
  if (scene.NonBlackLightCount() >= kManyLights)
    tree_ = LightTree(scene.Lights(), BoundingSphere(scene.WorldBounds()));
  for (std::size_t i = 0; i < scene.Lights().size(); ++i)
    indices_.emplace(scene.Lights()[i].get(), int(i));
}

}  // namespace exphoton
