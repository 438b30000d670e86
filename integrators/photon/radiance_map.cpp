// SPDX-License-Identifier: BSD-2-Clause
// Computing radiance photons and finding the one that serves a hit.
#include "integrators/photon/radiance_map.h"

#include <algorithm>
#include <bit>

#include "core/base/parallel.h"
#include "core/base/progress.h"

namespace exphoton {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t(0);

// A distance with a place in a list of up to 31.
using Key = std::conditional_t<sizeof(Real) == 4, std::uint64_t, unsigned __int128>;
constexpr int kPlaceBits = 5;

// The entries of one seed: one, or two where the surface transmits; none where it is black.
struct SeedEntries {
  RadianceMap::Entry sides[2];
  int count = 0;
};

SeedEntries ComputeEntries(const RadianceSeed& seed, const PhotonMaps& maps, RadianceMode mode,
                           bool needsTransmission, Arena* arena) {
  const bool reflects = !seed.reflectance.IsBlack();
  const bool transmits = needsTransmission && !seed.transmittance.IsBlack();
  SeedEntries result;
  if (!reflects && !transmits) return result;
  const auto front = maps.EstimateIrradiance(seed.p, seed.n, arena);
  if (mode == RadianceMode::Irradiance) {
    result.sides[result.count++] = {seed.n, front.e, front.radius};
    if (transmits) {
      const auto back = maps.EstimateIrradiance(seed.p, -seed.n, arena);
      result.sides[result.count++] = {-seed.n, back.e, back.radius};
    }
    return result;
  }
  if (!transmits) {
    result.sides[result.count++] = {seed.n, seed.reflectance * front.e * kInvPi, front.radius};
    return result;
  }
  const auto back = maps.EstimateIrradiance(seed.p, -seed.n, arena);
  const Real radius = std::max(front.radius, back.radius);
  const Spectrum rho = seed.reflectance * kInvPi, tau = seed.transmittance * kInvPi;
  result.sides[result.count++] = {seed.n, rho * front.e + tau * back.e, radius};
  result.sides[result.count++] = {-seed.n, rho * back.e + tau * front.e, radius};
  return result;
}

}  // namespace

RadianceMap::RadianceMap(const std::vector<RadianceSeed>& seeds, const PhotonMaps& maps,
                         const PhotonSettings& settings, bool needsTransmission,
                         PreprocessContext& context)
    : minCosine_(settings.radianceNormal), reach_(settings.radianceReach) {
  constexpr std::size_t kChunk = 256;
  const std::size_t chunks = (seeds.size() + kChunk - 1) / kChunk;
  std::vector<SeedEntries> computed(seeds.size());
  std::vector<Arena> arenas(std::size_t(context.threads.Count()));
  context.progress.Begin("Computing photon radiances", std::int64_t(chunks));
  context.threads.For(std::int64_t(chunks), [&](std::int64_t chunk, int worker) {
    const std::size_t begin = std::size_t(chunk) * kChunk;
    const std::size_t end = std::min(begin + kChunk, seeds.size());
    for (std::size_t i = begin; i < end; ++i)
      computed[i] = ComputeEntries(seeds[i], maps, settings.radianceMode, needsTransmission,
                                   &arenas[std::size_t(worker)]);
    context.progress.Advance();
  });
  context.progress.End();

  std::vector<Point3> points;
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (int side = 0; side < computed[i].count; ++side) {
      points.push_back(seeds[i].p);
      entries.push_back(computed[i].sides[side]);
    }
  tree_ = PointKdTree(points);
  entries_.reserve(entries.size());
  for (std::uint32_t i : tree_.Order()) {
    entries_.push_back(entries[i]);
    maxReach2_ = std::max(maxReach2_, Square(reach_ * entries[i].radius));
  }
  std::vector<Normal3> normals;
  normals.reserve(entries_.size());
  for (const Entry& entry : entries_) normals.push_back(entry.n);
  cells_ = NearestCells(tree_, normals, context.threads);
}

std::size_t RadianceMap::MemoryBytes() const {
  return tree_.MemoryBytes() + cells_.MemoryBytes() + entries_.capacity() * sizeof(Entry);
}

NearPoint RadianceMap::NearestListed(const NearestCells::Cell& cell, const Point3& p,
                                     const Normal3& n) const {
  constexpr int kCount = NearestCells::kListed;
  Real distance2[kCount];
  cells_.Distances2(cell, p, distance2);
  // Bits of distances order as they do; the place in the list, below them, decides ties. Ids
  // ascend, so that of equal distances the lower id wins. Four minima at a time.
  Key keys[kCount];
  for (int j = 0; j < kCount; ++j)
    keys[j] = Key(std::bit_cast<RealBits>(distance2[j])) << kPlaceBits | Key(j);
  for (;;) {
    Key best[4] = {keys[0], keys[1], keys[2], keys[3]};
    for (int j = 4; j < kCount; j += 4)
      for (int lane = 0; lane < 4; ++lane) best[lane] = std::min(best[lane], keys[j + lane]);
    const Key nearest = std::min(std::min(best[0], best[1]), std::min(best[2], best[3]));
    const auto place = int(nearest & ((1 << kPlaceBits) - 1));
    if (place >= kCount) return {kInfinity, kNone};
    if (Serves(cell.ids[place], distance2[place], n)) return {distance2[place], cell.ids[place]};
    keys[place] = ~Key(0);
  }
}

const RadianceMap::Entry* RadianceMap::Find(const Point3& p, const Normal3& n,
                                            Place place) const {
  NearPoint nearest{maxReach2_, kNone};
  if (place) {
    const NearPoint listed = NearestListed(*place, p, n);
    if (place->Proves(listed.distance2, p)) return &entries_[listed.index];
    if (listed.index != kNone) nearest = listed;
  }
  tree_.Search(p, &nearest.distance2, [&](std::uint32_t i, Real distance2) {
    if (!Serves(i, distance2, n)) return;
    // Ties go to the lower index, in whatever order they are met.
    if (distance2 == nearest.distance2 && i > nearest.index) return;
    nearest = {distance2, i};
  });
  return nearest.index == kNone ? nullptr : &entries_[nearest.index];
}

}  // namespace exphoton
