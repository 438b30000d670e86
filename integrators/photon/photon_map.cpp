// SPDX-License-Identifier: BSD-2-Clause
// Photon maps: searching with the side and height tests inside the search.
#include "integrators/photon/photon_map.h"

#include <algorithm>
#include <cmath>

#include "core/spatial/nearest_set.h"

namespace exphoton {

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
  }
}

std::size_t PhotonMap::MemoryBytes() const {
  return tree_.MemoryBytes() + directions_.capacity() * sizeof(Vector3) +
         alphas_.capacity() * sizeof(Spectrum);
}

PhotonNeighbourhood PhotonMap::Find(const PhotonQuery& query, Arena* arena) const {
  const Real maxRadius2 = Square(query.maxDistance);
  if (IsEmpty()) return {{}, maxRadius2};
  const int k = int(std::min<std::size_t>(std::size_t(query.k), Size() + 1));
  NearestSet nearest(arena->MakeArray<NearPoint>(NearestSet::BufferSize(k)), k);
  Real radius2 = maxRadius2;
  tree_.Search(query.p, &radius2, [&](std::uint32_t i, Real distance2) {
    if (query.isOneSided && !(Dot(directions_[i], query.n) > 0)) return;
    const Real height = Dot(tree_.Point(i) - query.p, query.n);
    const Real flat2 =
        std::max(distance2, Square(height / kFlatness));  // docs/exphotonmap.md, eq. 11
    if (flat2 <= radius2) nearest.Offer({flat2, i}, &radius2);
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
  NearestSet nearest(arena->MakeArray<NearPoint>(NearestSet::BufferSize(wanted)), wanted);
  Real radius2 = kInfinity;
  tree_.Search(p, &radius2, [&](std::uint32_t i, Real distance2) {
    nearest.Offer({distance2, i}, &radius2);
  });
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
    Real farthest2 = 0;
    for (const NearPoint& point : near) farthest2 = std::max(farthest2, point.distance2);
    radii.push_back(std::sqrt(farthest2));
    arena->Rewind(mark);
  }
  const auto at = std::ptrdiff_t(kQuantile * double(radii.size() - 1));
  std::nth_element(radii.begin(), radii.begin() + at, radii.end());
  return std::max(radii[std::size_t(at)], minRadius_);
}

}  // namespace exphoton
