// SPDX-License-Identifier: BSD-2-Clause
// Photon maps: searching with the side and height tests inside the search.
#include "integrators/photon/photon_map.h"

#include <algorithm>
#include <cmath>

#include "core/spatial/nearest_set.h"

namespace exphoton {
namespace {

Real Farthest2(std::span<const NearPoint> points) {
  Real farthest2 = 0;
  for (const NearPoint& point : points) farthest2 = std::max(farthest2, point.distance2);
  return farthest2;
}

std::span<NearPoint> BufferFor(int k, Arena* arena) {
  return arena->MakeArray<NearPoint>(NearestSet<KeepAll>::BufferSize(k));
}

}  // namespace

PhotonMap::PhotonMap(PhotonHaul haul) : paths_(haul.paths) {
  std::vector<Point3> points;
  points.reserve(haul.photons.size());
  for (const Photon& photon : haul.photons) points.push_back(photon.p);
  tree_ = PointKdTree(points);
  directions_.reserve(points.size());
  alphas_.reserve(points.size());
  for (std::uint32_t i : tree_.Order()) {
    directions_.push_back(haul.photons[i].wi);
    alphas_.push_back(haul.photons[i].alpha);
  }
  if (!IsEmpty()) {
    const Real largest = MaxComponent(Max(Abs(tree_.Bounds().min), Abs(tree_.Bounds().max)));
    minRadius_ = 4 * kMachineEpsilon * largest;
    MeasureSpacing();
  }
}

void PhotonMap::MeasureSpacing() {
  constexpr std::size_t kPhotonsPerCell = 64;
  constexpr int kNeighbours = 32;
  int level = 0;
  while (level < tree_.Levels() && (Size() >> level) > kPhotonsPerCell) ++level;
  std::vector<Real> spacing2(std::size_t(1) << level);
  Arena arena;
  for (std::uint32_t cell = 0; cell < spacing2.size(); ++cell) {
    const Point3 p = Position(tree_.MiddleOf(cell, level));
    spacing2[cell] = Farthest2(Nearest(p, kNeighbours, &arena)) / kNeighbours;
    arena.Reset();
  }
  spacing2_ = std::move(spacing2);
  spacingLevel_ = level;
}

Real PhotonMap::ExpectedRadius2(const Point3& p, int k) const {
  if (spacing2_.empty()) return kInfinity;
  const Real expected2 = spacing2_[tree_.CellAt(p, spacingLevel_)] * Real(k);
  return expected2 > 0 ? expected2 : kInfinity;
}

std::size_t PhotonMap::MemoryBytes() const {
  return tree_.MemoryBytes() + spacing2_.capacity() * sizeof(Real) +
         directions_.capacity() * sizeof(Vector3) + alphas_.capacity() * sizeof(Spectrum);
}

// A search that begins with the radius in which k photons are to be expected, and is repeated with
// a larger one where they are not there: what is found is the same as with the largest at once.
// measure(leaf, distance2) may change the distances of a leaf's points, to larger ones.
template <class Set, class Measure>
void PhotonMap::SearchFrom(const Point3& p, int k, Real maxRadius2, Set* nearest,
                           Measure&& measure) const {
  const auto search = [&](Real radius2) {
    tree_.SearchLeaves(p, &radius2, [&](const PointKdTree::Leaf& leaf, Real* distance2) {
      measure(leaf, distance2);
      nearest->OfferLeaf(leaf, distance2, &radius2);
    });
  };
  const Real expected2 = ExpectedRadius2(p, k);
  for (const Real factor : {Real(1.5), Real(6)}) {
    if (!(expected2 * factor < maxRadius2)) break;
    search(expected2 * factor);
    if (!nearest->IsShort()) return;
    nearest->Clear();
  }
  search(maxRadius2);
}

PhotonNeighbourhood PhotonMap::Find(const PhotonQuery& query, Arena* arena) const {
  const Real maxRadius2 = Square(query.maxDistance);
  if (IsEmpty()) return {{}, maxRadius2};
  const int k = int(std::min<std::size_t>(std::size_t(query.k), Size() + 1));
  const Point3 p = query.p;
  const Normal3 n = query.n;
  const bool isOneSided = query.isOneSided;
  NearestSet nearest(BufferFor(k, arena), k, [this, n, isOneSided](std::uint32_t i) {
    return !isOneSided || Dot(directions_[i], n) > 0;
  });
  SearchFrom(p, k, maxRadius2, &nearest, [p, n](const PointKdTree::Leaf& leaf, Real* distance2) {
    for (std::uint32_t j = 0; j < PointKdTree::kMaxLeafPoints;
         ++j) {  // docs/exphotonmap.md, eq. 11
      const Real height =
          (leaf.x[j] - p.x) * n.x + (leaf.y[j] - p.y) * n.y + (leaf.z[j] - p.z) * n.z;
      const Real flat2 = Square(height * (1 / kFlatness));
      distance2[j] = flat2 > distance2[j] ? flat2 : distance2[j];
    }
  });
  const std::span<const NearPoint> found = nearest.Finish();
  if (found.size() < std::size_t(query.k)) return {found, maxRadius2};
  const Real floor2 = std::max(Square(minRadius_), std::numeric_limits<Real>::min());
  const Real farthest2 = found.back().distance2;
  if (farthest2 < floor2) return {found, floor2};  // coincident photons: a disk no smaller
  return {found.first(found.size() - 1), farthest2};
}

PhotonMap::Irradiance PhotonMap::EstimateIrradiance(const PhotonQuery& query, Arena* arena) const {
  const Arena::Mark mark = arena->GetMark();
  const PhotonNeighbourhood around = Find(query, arena);
  Spectrum sum;
  for (const NearPoint& near : around.photons) sum += alphas_[near.index];
  arena->Rewind(mark);
  if (around.photons.empty()) return {{}, query.maxDistance};
  return {sum * (kInvPi / (Real(paths_) * around.radius2)), std::sqrt(around.radius2)};
}

std::span<const NearPoint> PhotonMap::Nearest(const Point3& p, int k, Arena* arena) const {
  if (IsEmpty()) return {};
  const int wanted = int(std::min<std::size_t>(std::size_t(k), Size()));
  NearestSet nearest(BufferFor(wanted, arena), wanted, KeepAll());
  SearchFrom(p, wanted, kInfinity, &nearest, [](const PointKdTree::Leaf&, Real*) {});
  return nearest.Finish();
}

Real PhotonMap::TypicalRadius(int k, Arena* arena) const {
  constexpr std::size_t kSamples = 256;
  constexpr double kQuantile = .9;
  if (IsEmpty()) return 0;
  std::vector<Real> radii;
  const std::size_t step = std::max<std::size_t>(1, Size() / kSamples);
  for (std::size_t i = 0; i < Size(); i += step) {
    const Arena::Mark mark = arena->GetMark();
    // One more than k: the photon itself is among them, at distance 0.
    const auto near = Nearest(tree_.Point(std::uint32_t(i)), k + 1, arena);
    radii.push_back(std::sqrt(Farthest2(near)));
    arena->Rewind(mark);
  }
  const auto at = std::ptrdiff_t(kQuantile * double(radii.size() - 1));
  std::nth_element(radii.begin(), radii.begin() + at, radii.end());
  return std::max(radii[std::size_t(at)], minRadius_);
}

}  // namespace exphoton
