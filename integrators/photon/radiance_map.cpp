// SPDX-License-Identifier: BSD-2-Clause
// Computing radiance photons and finding the one that serves a hit.
#include "integrators/photon/radiance_map.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/progress.h"

namespace exphoton {
namespace {

// Appends the entries of one seed: one, or two where the surface transmits; none where it is black.
// reach2 is the squared radius of the estimate yet.
void ComputeEntries(const RadianceSeed& seed, const PhotonMaps& maps, RadianceMode mode,
                    bool needsTransmission, Arena* arena, std::vector<RadianceRecord>* entries) {
  const bool reflects = !seed.reflectance.IsBlack();
  const bool transmits = needsTransmission && !seed.transmittance.IsBlack();
  if (!reflects && !transmits) return;
  const auto add = [&](const Normal3& n, Real radius, const Spectrum& value) {
    entries->push_back({seed.p, EncodeOctahedral(n), Square(radius), value});
  };
  const bool isExitant = mode == RadianceMode::Exitant;
  const Spectrum rho = seed.reflectance * kInvPi, tau = seed.transmittance * kInvPi;
  const auto front = maps.EstimateIrradiance(seed.p, seed.n, arena);
  if (!transmits) {
    add(seed.n, front.radius, isExitant ? rho * front.e : front.e);
    return;
  }
  const auto back = maps.EstimateIrradiance(seed.p, -seed.n, arena);
  if (isExitant) {
    const Real radius = std::max(front.radius, back.radius);
    add(seed.n, radius, rho * front.e + tau * back.e);
    add(-seed.n, radius, rho * back.e + tau * front.e);
  } else {
    add(seed.n, front.radius, front.e);
    add(-seed.n, back.radius, back.e);
  }
}

}  // namespace

RadianceMap::RadianceMap(std::span<RadianceSeed> seeds, const PhotonMaps& maps,
                         const PhotonSettings& settings, bool needsTransmission,
                         PreprocessContext& context)
    : minCosine_(settings.radianceNormal), reach_(settings.radianceReach) {
  constexpr std::size_t kChunk = 256, kBatch = 64;
  // Neighbours one after the other: they read the same photons.
  BlockOrder<RadianceSeed>::Sort(seeds, context.threads);
  const std::size_t chunks = (seeds.size() + kChunk - 1) / kChunk;
  BlockStore<RadianceBlock> entries;
  std::vector<Arena> arenas(std::size_t(context.threads.Count()));
  context.progress.Begin("Computing photon radiances", std::int64_t(chunks));
  for (std::size_t first = 0; first < chunks; first += kBatch) {
    std::vector<std::vector<RadianceRecord>> computed(std::min(kBatch, chunks - first));
    context.threads.For(std::int64_t(computed.size()), [&](std::int64_t i, int worker) {
      const std::size_t begin = (first + std::size_t(i)) * kChunk;
      for (const RadianceSeed& seed : seeds.subspan(begin, std::min(kChunk, seeds.size() - begin)))
        ComputeEntries(seed, maps, settings.radianceMode, needsTransmission,
                       &arenas[std::size_t(worker)], &computed[std::size_t(i)]);
      for (RadianceRecord& entry : computed[std::size_t(i)]) entry.reach2 *= Square(reach_);
      context.progress.Advance();
    });
    for (const auto& chunk : computed) {
      entries.Append(chunk);
      for (const RadianceRecord& entry : chunk) maxReach2_ = std::max(maxReach2_, entry.reach2);
    }
  }
  context.progress.End();
  tree_ = PointTree<RadianceBlock>(std::move(entries), context.threads);
  grid_ = NearGrid(tree_.View(), kGridCellsPerEntry * tree_.Size(), context.threads);
}

void RadianceMap::Find(std::span<const Place> places, std::optional<Entry>* found) const {
  constexpr std::size_t kAtOnce = 16;
  ClosestPoint closest[kAtOnce];
  for (; !places.empty(); places = places.subspan(std::min(kAtOnce, places.size()))) {
    const auto some = places.first(std::min(kAtOnce, places.size()));
    FastestNearestSearch().closest(View(), {minCosine_, maxReach2_}, some, closest);
    for (std::size_t i = 0; i < some.size(); ++i, ++found) {
      found->reset();
      if (closest[i].index == ClosestPoint::kNone) continue;
      const RadianceBlock& block = tree_.BlockOf(closest[i].index);
      const std::uint32_t lane = tree_.Lane(closest[i].index);
      *found = {block.Value(lane), SafeDivide(block.reach2[lane], Square(reach_), 0),
                closest[i].distance2};
    }
  }
}

}  // namespace exphoton
