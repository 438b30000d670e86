// SPDX-License-Identifier: BSD-2-Clause
// PhotonMap applies the side and height tests inside the k-NN search.
#include "integrators/photon/maps/photon_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scattering/bxdf.h"
#include "core/spatial/search_start.h"
#include "core/transport/shading_normal.h"
#include "integrators/photon/maps/hidden_photons.h"

namespace exphoton {
namespace {

constexpr Real kLeastLimitOnBump = 4;  // of a photon's weight

NearBuffer BufferFor(std::size_t k, Arena* arena) {
  const std::size_t size = NearBuffer::SizeFor(k);
  return {{arena->AllocateArray<Real>(size), size},
          {arena->AllocateArray<std::uint32_t>(size), size}};
}

}  // namespace

PhotonMap::PhotonMap(PointTree<PhotonBlock> tree, const PhotonBuffer& buffer, ThreadPool& threads)
    : tree_(std::move(tree)),
      spacing2_(MeasureSpacing2(tree_.View(), threads)),
      paths_(buffer.paths),
      isGuided_(buffer.isGuided),
      farthest_(buffer.farthest),
      exposure_(buffer.times) {
  if (IsEmpty()) return;
  const Bounds3 bounds = tree_.Bounds();
  minRadius_ = 4 * kMachineEpsilon * MaxComponent(Max(Abs(bounds.min), Abs(bounds.max)));
}

std::size_t PhotonMap::MemoryBytes() const {
  return tree_.MemoryBytes() + spacing2_.capacity() * sizeof(Real);
}

PhotonNeighbourhood PhotonMap::Find(const PhotonQuery& query, Arena* arena) const {
  const Real maxRadius2 = Square(query.maxDistance), area = Real(query.diskArea);
  if (IsEmpty()) return {{}, {}, maxRadius2 * area};
  NearestQuery nearest;
  nearest.p = query.p;
  nearest.n = query.n;
  nearest.k = std::uint32_t(std::min<std::size_t>(std::size_t(query.k), Size() + 1));
  nearest.maxRadius2 = maxRadius2;
  nearest.isFlattened = true;  // docs/theory/exphotonmap.md, eq. 11
  nearest.steepness = 1 / kFlatness;
  nearest.isOneSided = query.isOneSided;
  const NearBuffer buffer = BufferFor(nearest.k, arena);
  const NearPoints found = FastestNearestSearch().nearest(View(), nearest, buffer);
  if (found.size() < std::size_t(query.k)) return {found.index, found.distance2, maxRadius2 * area};
  const Real floor2 = SmallestRadius2();
  const Real farthest2 = found.distance2[found.farthest];
  // Coincident photons: the radius is at least the rounding error of positions.
  if (farthest2 < floor2) return {found.index, found.distance2, floor2};
  // Remove the farthest photon: the last one takes its place.
  const std::size_t last = found.size() - 1;
  buffer.distance2[found.farthest] = buffer.distance2[last];
  buffer.index[found.farthest] = buffer.index[last];
  return {found.index.first(last), found.distance2.first(last), farthest2 * area};
}

PhotonMap::Irradiance PhotonMap::EstimateIrradiance(const PhotonQuery& query, Arena* arena,
                                                    const Walls& walls) const {
  const Arena::Mark mark = arena->GetMark();
  const SeenPhotons seen = WithoutHidden(*this, query, Find(query, arena), walls, arena);
  const PhotonNeighbourhood& around = seen.around;
  const Real spacings = Real(kOwnDisk * query.k * query.diskArea);
  Irradiance found;
  Real largest2 = 0;
  std::size_t owns = 0;
  for (std::size_t at = 0; at < around.photons.size(); ++at) {
    const std::uint32_t i = around.photons[at];
    const Real distance2 = around.distance2[at],
               disk2 = std::min(OwnDisk2(i, spacings), around.radius2);
    if (distance2 > disk2) continue;
    largest2 = std::max(largest2, disk2);
    const Real weight = WeightOf(query, i);
    const Spectrum part = Alpha(i) * (weight * kInvPi / (Real(paths_) * disk2 * around.share));
    const bool isOwn = !(distance2 > 0);
    (isOwn ? found.own : found.e) += part;
    (isOwn ? found.signedOwn : found.signedE) += part * Sign(i);
    if (isOwn) found.ownDisk2 = double(disk2), ++owns;
  }
  found.isBesideWall = IsBesideWall(*this, query, seen, walls);
  arena->Rewind(mark);
  const Real radius2 = around.radius2, ofDisks2 = largest2 / Real(kOwnDisk);
  found.density = double(around.photons.size() - owns) / double(radius2) * query.diskArea;
  found.radius = std::sqrt(largest2 > 0 ? std::min(radius2, ofDisks2) : radius2);
  return found;
}

// Returns the factor of the photon's power, by the surface at the place of an irradiance. On bumps
// a single photon that arrives along the surface could outshine all others. It counts for at most
// half of the k photons.
Real PhotonMap::WeightOf(const PhotonQuery& query, std::uint32_t i) const {
  Real weight = 1;
  if (query.isCoated) weight = CoatTransmission(AbsDot(Direction(i), query.n));
  if (query.normals.HasBumps()) {
    const Real limit = std::max(kLeastLimitOnBump, Real(query.k) / 2);
    weight *=
        std::min(CosineRatio(Direction(i), query.normals.bumped, query.normals.smooth), limit);
  }
  return weight;
}

// Few photons, or photons that coincide, show no spacing.
Real PhotonMap::OwnDisk2(std::uint32_t i, Real spacings) const {
  if (Size() < kSpacingNeighbours) return std::numeric_limits<Real>::infinity();
  return std::max(spacing2_[i / PointTreeView::kSpacingPoints] * spacings, SmallestRadius2());
}

NearPoints PhotonMap::Nearest(const Point3& p, int k, Arena* arena) const {
  if (IsEmpty()) return {};
  NearestQuery query;
  query.p = p;
  query.k = std::uint32_t(std::min<std::size_t>(std::size_t(k), Size()));
  return FastestNearestSearch().nearest(View(), query, BufferFor(query.k, arena));
}

Real PhotonMap::TypicalRadius(int k, Arena* arena) const {
  constexpr std::size_t kSamples = 256;
  constexpr double kQuantile = .9;
  if (IsEmpty()) return 0;
  constexpr Real kHeavy = 4;  // in units of the median luminance
  const std::size_t step = std::max<std::size_t>(1, Size() / kSamples);
  std::vector<Real> luminances, radii;
  for (std::size_t i = 0; isGuided_ && i < Size(); i += step)
    luminances.push_back(Alpha(std::uint32_t(i)).Y());
  const auto median = luminances.begin() + std::ptrdiff_t(luminances.size() / 2);
  std::nth_element(luminances.begin(), median, luminances.end());
  for (std::size_t i = 0; i < Size(); i += step) {
    if (isGuided_ && Alpha(std::uint32_t(i)).Y() > kHeavy * *median) continue;
    const Arena::Mark mark = arena->GetMark();
    // Query k + 1 photons, because the photon itself is found at distance 0.
    const NearPoints near = Nearest(Position(std::uint32_t(i)), k + 1, arena);
    radii.push_back(near.size() == 0 ? 0 : std::sqrt(near.distance2[near.farthest]));
    arena->Rewind(mark);
  }
  const auto at = std::ptrdiff_t(kQuantile * double(radii.size() - 1));
  std::nth_element(radii.begin(), radii.begin() + at, radii.end());
  return std::max(radii[std::size_t(at)], minRadius_);
}

}  // namespace exphoton
