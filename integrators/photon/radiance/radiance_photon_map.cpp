// SPDX-License-Identifier: BSD-2-Clause
// RadiancePhotonMap computes the radiance photons, and finds the one that is valid for a hit.
#include "integrators/photon/radiance/radiance_photon_map.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/progress.h"

namespace exphoton {
namespace {

// Returns the number of entries for a site: two if the surface transmits, none if it is black.
int CountEntries(const RadiancePhotonSite& site, bool needsTransmission) {
  if (needsTransmission && !site.transmittance.IsBlack()) return 2;
  return site.reflectance.IsBlack() ? 0 : 1;
}

// Computes all `entries` of a site. radius2 receives the squared radius of the density estimate;
// the caller scales it to the validity radius.
void ComputeEntries(const RadiancePhotonSite& site, const PhotonMapSet& maps, Arena* arena,
                    std::span<RadianceRecord> entries) {
  if (entries.empty()) return;
  const Spectrum rho = site.reflectance * kInvPi, tau = site.transmittance * kInvPi;
  using Irradiance = PhotonMapSet::Irradiance;
  const auto entry = [&](const Normal3& n, Real radius, const Irradiance& on,
                         const Irradiance& behind) {
    const Spectrum value = rho * on.e + tau * behind.e;
    const Spectrum signedValue = rho * on.signedE + tau * behind.signedE;
    return RadianceRecord{site.p,
                          EncodeOctahedral(n),
                          Square(radius),
                          PackedRadiance(value, site.glossyShare, site.isCoated),
                          PackedRatios(signedValue, value),
                          on.isBesideWall};
  };
  const auto front = maps.EstimateIrradiance(site.p, site.n, arena, site.isCoated, site.normals);
  if (entries.size() == 1) {
    entries[0] = entry(site.n, front.radius, front, {});
    return;
  }
  const auto back = maps.EstimateIrradiance(site.p, -site.n, arena, site.isCoated, site.normals);
  const Real radius = std::max(front.radius, back.radius);
  entries[0] = entry(site.n, radius, front, back);
  entries[1] = entry(-site.n, radius, back, front);
}

}  // namespace

RadiancePhotonMap::RadiancePhotonMap(std::span<RadiancePhotonSite> sites, const PhotonMapSet& maps,
                                     const PhotonSettings& settings, bool needsTransmission,
                                     PreprocessContext& context)
    : minCosine_(settings.radianceNormal), reach_(settings.radianceReach) {
  constexpr std::size_t kChunk = 256;
  // Process neighbours one after the other, because they read the same photons.
  BlockOrder<RadiancePhotonSite>::Sort(sites, context.threads);
  const std::size_t chunks = (sites.size() + kChunk - 1) / kChunk;
  const auto sitesOf = [&](std::size_t chunk) {
    return sites.subspan(chunk * kChunk, std::min(kChunk, sites.size() - chunk * kChunk));
  };
  std::vector<std::size_t> first{0};  // index of each chunk's first entry, then the total
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    first.push_back(first.back());
    for (const RadiancePhotonSite& site : sitesOf(chunk))
      first.back() += std::size_t(CountEntries(site, needsTransmission));
  }
  BlockStore<RadianceBlock> entries;
  entries.Resize(first.back());
  std::vector<Arena> arenas(std::size_t(context.threads.Count()));
  context.progress.Begin("Computing photon radiances", std::int64_t(chunks));
  context.threads.For(std::int64_t(chunks), [&](std::int64_t chunk, int worker) {
    std::size_t at = first[std::size_t(chunk)];
    for (const RadiancePhotonSite& site : sitesOf(std::size_t(chunk))) {
      const auto count = std::size_t(CountEntries(site, needsTransmission));
      const auto computed = entries.Records().subspan(at, count);
      ComputeEntries(site, maps, &arenas[std::size_t(worker)], computed);
      for (RadianceRecord& entry : computed) entry.radius2 *= Square(reach_);
      at += count;
    }
    context.progress.Advance();
  });
  for (const RadianceRecord& entry : entries.Records())
    maxRadius2_ = std::max(maxRadius2_, entry.radius2);
  context.progress.End();
  tree_ = PointTree<RadianceBlock>(std::move(entries), context.threads);
  grid_ = EntryGrid(tree_.View(), kGridCellsPerEntry * tree_.Size(), context.threads);
}

void RadiancePhotonMap::Find(std::span<const Place> places, std::optional<Entry>* found) const {
  constexpr std::size_t kAtOnce = 16;
  ClosestPoint closest[kAtOnce];
  for (; !places.empty(); places = places.subspan(std::min(kAtOnce, places.size()))) {
    const auto some = places.first(std::min(kAtOnce, places.size()));
    FastestNearestSearch().closest(View(), {minCosine_, maxRadius2_}, some, closest);
    for (std::size_t i = 0; i < some.size(); ++i, ++found) {
      found->reset();
      if (closest[i].index == ClosestPoint::kNone) continue;
      const RadianceBlock& block = tree_.BlockOf(closest[i].index);
      const std::uint32_t lane = tree_.Lane(closest[i].index);
      *found = {block.value[lane],
                block.signedRatios[lane],
                SafeDivide(block.radius2[lane], Square(reach_), 0),
                closest[i].distance2,
                block.isBesideWall[lane],
                tree_.Position(closest[i].index)};
    }
  }
}

}  // namespace exphoton
