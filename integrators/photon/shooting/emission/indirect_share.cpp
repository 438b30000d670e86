// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/photon/shooting/emission/indirect_share.h"

#include <algorithm>
#include <cmath>

#include "core/spatial/nearest_search.h"

namespace exphoton {
namespace {

constexpr std::uint32_t kNear = 16;            // photons of an estimate
constexpr double kUnseenPlaces = 4;            // which may have indirect light alone
constexpr double kFullShare = 1. / 8;          // from this share on, all photons are wanted
constexpr std::int64_t kLeastIndirect = 1000;  // fewer photons do not make a map

// RoughIrradiance estimates the luminance of irradiance from some photons of one map.
class RoughIrradiance {
 public:
  RoughIrradiance(const SomePhotons& photons, ThreadPool& threads) {
    if (photons.Size() < kNear) return;
    paths_ = photons.Paths();
    BlockStore<PhotonBlock> store;
    store.Append(photons.Records());
    tree_ = PointTree<PhotonBlock>(std::move(store), threads);
  }

  bool IsKnown() const { return tree_.Size() > 0; }

  // Returns the estimate of the nearest photons, wherever they are.
  double Around(const VisiblePoint& point) const {
    return IsKnown() ? Estimate(Nearest(*this, point).found) : 0;
  }

  // Returns 0 at a point that sees neither the nearest one of these photons nor the farthest one:
  // they are in another room.
  double At(const VisiblePoint& point, const Scene& scene) const {
    if (!IsKnown()) return 0;
    const Nearest nearest(*this, point);
    const NearPoints& near = nearest.found;
    if (near.size() < kNear) return 0;
    const auto closest =
        std::size_t(std::ranges::min_element(near.distance2) - near.distance2.begin());
    const bool isSeen =
        Sees(point, near.index[closest], scene) || Sees(point, near.index[near.farthest], scene);
    return isSeen ? Estimate(near) : 0;
  }

 private:
  // Photons that arrive on the side of the normal, by the distance of density estimates.
  struct Nearest {
    Nearest(const RoughIrradiance& map, const VisiblePoint& point) {
      constexpr Real kSteepness = 2;
      const NearestQuery query{point.p, kNear, kInfinity, true, kSteepness, true, point.n};
      found = FastestNearestSearch().nearest(map.tree_.View(), query, {distance2, index});
    }
    std::array<Real, NearBuffer::SizeFor(kNear)> distance2;
    std::array<std::uint32_t, NearBuffer::SizeFor(kNear)> index;
    NearPoints found;
  };

  // The farthest photon only gives the radius. Photons that coincide give no finite estimate, and
  // count as no light.
  double Estimate(const NearPoints& near) const {
    if (near.size() < kNear) return 0;
    double power = 0;
    for (std::size_t i = 0; i < near.size(); ++i)
      if (i != near.farthest) power += Power(near.index[i]);
    const double radius2 = double(near.distance2[near.farthest]);
    return radius2 > 0 ? power / (M_PI * radius2 * paths_) : 0;
  }

  // Both ends move into the free space, as in Walls.
  bool Sees(const VisiblePoint& point, std::uint32_t photon, const Scene& scene) const {
    constexpr Real kLift = Real(.05), kEnd = Real(.999);
    const Point3 q = tree_.Position(photon);
    const Real lift = kLift * Distance(point.p, q);
    Ray ray;
    ray.o = point.p + Vector3(point.n) * lift;
    ray.d = q + tree_.Direction(photon) * lift - ray.o;
    ray.tMax = kEnd;
    return !scene.Occluded(ray);
  }

  double Power(std::uint32_t i) const { return double(tree_.BlockOf(i).Alpha(tree_.Lane(i)).Y()); }

  double paths_ = 1;
  PointTree<PhotonBlock> tree_;
};

}  // namespace

void SomePhotons::Add(std::span<const PhotonRecord> photons) {
  total_ += double(photons.size());
  const auto few = photons.first(std::min(photons.size(), kMost - records_.size()));
  records_.insert(records_.end(), few.begin(), few.end());
}

IndirectShare::IndirectShare(std::span<const VisiblePoint> points) {
  for (const VisiblePoint& point : points) places_.push_back({point});
}

void IndirectShare::AddLight(const Scene& scene, const SomePhotons& photons, ThreadPool& threads) {
  const RoughIrradiance light(photons, threads);
  for (Place& place : places_) place.otherLight += light.At(place.point, scene);
}

double IndirectShare::UpperBound(const SomePhotons& photons, ThreadPool& threads) const {
  const RoughIrradiance indirect(photons, threads);
  double sum = kUnseenPlaces;
  double lit = 0;
  for (const Place& place : places_) {
    const double ofIndirect = indirect.Around(place.point), all = ofIndirect + place.otherLight;
    if (!(all > 0)) continue;
    const double share = ofIndirect / all;
    sum += share * share;
    ++lit;
  }
  return sum < lit ? std::sqrt(sum / lit) : 1;
}

std::int64_t EnoughIndirectPhotons(double share, std::int64_t wanted) {
  const double part = std::min(share / kFullShare, 1.);
  const auto enough = std::int64_t(std::ceil(part * part * double(wanted)));
  return std::min(std::max(enough, kLeastIndirect), wanted);
}

}  // namespace exphoton
