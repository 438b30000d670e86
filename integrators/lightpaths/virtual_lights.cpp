// SPDX-License-Identifier: BSD-2-Clause
// VirtualLights: light paths in parallel blocks, merged in order.
#include "integrators/lightpaths/virtual_lights.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/progress.h"
#include "integrators/photon/shooting/photon_path_sampler.h"

namespace exphoton {
namespace {

constexpr std::uint64_t kVirtualLightStream = 0x69676c;
constexpr int kPathsTogether = 64;  // light paths of a parallel task
constexpr int kMaxBounces = 1024;

}  // namespace

// Light paths of a task, and the memory of their BSDFs.
struct VirtualLights::Block {
  Arena arena;
  std::vector<LightPathVertex> lights;
  RayCounters rays;
};

VirtualLights::VirtualLights() = default;
VirtualLights::~VirtualLights() = default;

void VirtualLights::Clear() {
  sets_.clear();
  blocks_.clear();
}

std::size_t VirtualLights::Count() const {
  std::size_t count = 0;
  for (const auto& set : sets_) count += set.size();
  return count;
}

void VirtualLights::Trace(const Scene& scene, int sets, int paths, PreprocessContext& context) {
  Clear();
  sets_.resize(std::size_t(sets));
  tracer_ = LightPathTracer(scene, false);
  const int perSet = (paths + kPathsTogether - 1) / kPathsTogether;
  blocks_.resize(std::size_t(sets) * std::size_t(perSet));
  context.progress.Begin("Tracing light paths", std::int64_t(blocks_.size()));
  const auto [open, close] = scene.Exposure();
  context.threads.For(
      std::int64_t(blocks_.size()), [&, open = open, close = close](std::int64_t b, int) {
        context.CheckStop();
        auto block = std::make_unique<Block>();
        const std::int64_t set = b / perSet, first = b % perSet * kPathsTogether;
        const std::int64_t end = std::min<std::int64_t>(first + kPathsTogether, paths);
        LightPath path;
        for (std::int64_t i = first; i < end; ++i) {
          const std::uint64_t index = std::uint64_t(set * paths + i);
          const PhotonPathSequences sequences(context.seed, index);
          PhotonPathSampler sampler(sequences, index);
          const Point2 choice = sampler.Next2D(), position = sampler.Next2D();
          const Point2 direction = sampler.Next2D();
          const Real time = open == close ? open : Lerp(sampler.Time(), open, close);
          tracer_.Trace({choice.x, position, direction, choice.y, time}, kMaxBounces,
                        {RandomStream(HashKey({context.seed, kVirtualLightStream, index})),
                         &block->arena, &block->rays},
                        &path);
          for (const LightPathVertex& vertex : path.vertices)
            if (vertex.point.bsdf.Has(LobeSet::NonSpecular)) block->lights.push_back(vertex);
        }
        blocks_[std::size_t(b)] = std::move(block);
      });
  context.progress.End();
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    auto& lights = sets_[b / std::size_t(perSet)];
    lights.insert(lights.end(), blocks_[b]->lights.begin(), blocks_[b]->lights.end());
    blocks_[b]->lights = {};
    context.statistics.AddRays(blocks_[b]->rays);
  }
}

}  // namespace exphoton
