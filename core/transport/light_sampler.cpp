// SPDX-License-Identifier: BSD-2-Clause
// LightSampler: the number of lights decides which of the two methods serves.
#include "core/transport/light_sampler.h"

namespace exphoton {
namespace {

constexpr double kUniformShare = 0.5;
// With fewer lights, the better choices of the tree are not worth the time of its walk.
constexpr int kManyLights = 16;

}  // namespace

LightSampler::LightSampler(const Scene& scene)
    : lights_(scene.Lights(), LightSelection::Power, kUniformShare) {
  if (scene.ShiningLights() >= kManyLights)
    tree_ = LightTree(scene.Lights(), BoundingSphere(scene.WorldBounds()));
  for (std::size_t i = 0; i < scene.Lights().size(); ++i)
    indices_.emplace(scene.Lights()[i].get(), int(i));
}

}  // namespace exphoton
