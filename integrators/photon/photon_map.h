// SPDX-License-Identifier: BSD-2-Clause
// PhotonMap: the photons of one kind, ready to be searched, with their own path count N. An empty
// map is legal: everything about it is zero. Knows nothing of how photons were shot.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/spatial/nearest_set.h"
#include "integrators/photon/photon.h"

namespace exphoton {

// Where and how far to look for photons.
struct PhotonQuery {
  Point3 p;
  Normal3 n;             // unit geometric normal of the receiver
  int k = 50;            // >= 2
  Real maxDistance = 0;  // > 0
  // Only photons that arrived on n's side count, during the search already: those on the far side
  // of a thin wall neither add light nor shrink the radius.
  bool isOneSided = true;
};

// The photons round a point. `photons` come in no particular order, but always in the same one.
struct PhotonNeighbourhood {
  std::span<const NearPoint> photons;  // those whose kernel weight is not 0 by construction
  Real radius2 = 0;                    // of the disk they stand for; > 0 if there are any
};

class PhotonMap {
 public:
  // A search region is flattened along the normal: a photon at height h counts as if it were at
  // least h / kFlatness away, which keeps corners and thin walls apart.
  static constexpr Real kFlatness = Real(.5);

  static constexpr std::size_t kBytesPerPhoton =
      sizeof(Point3) + sizeof(std::uint32_t) + sizeof(Vector3) + sizeof(Spectrum);

  PhotonMap() = default;
  explicit PhotonMap(PhotonHaul haul);

  bool IsEmpty() const { return tree_.Size() == 0; }
  std::size_t Size() const { return tree_.Size(); }
  std::int64_t Paths() const { return paths_; }
  const PointKdTree& Tree() const { return tree_; }
  Point3 Position(std::uint32_t i) const { return tree_.Point(i); }
  const Vector3& Direction(std::uint32_t i) const { return directions_[i]; }  // towards the light
  const Spectrum& Alpha(std::uint32_t i) const { return alphas_[i]; }
  std::size_t MemoryBytes() const;

  // The k nearest photons within maxDistance. Where there are k, the farthest is left out and gives
  // the radius; where there are fewer all count and the radius is maxDistance: both estimates are
  // then unbiased on a plane, and so is the switch between them.
  PhotonNeighbourhood Find(const PhotonQuery& query, Arena* arena) const;

  // Irradiance on the side of n, with the constant kernel: sum(alpha) / (N pi r^2). Returns r too.
  struct Irradiance {
    Spectrum e;
    Real radius = 0;
  };
  Irradiance EstimateIrradiance(const PhotonQuery& query, Arena* arena) const;

  // The k nearest photons at any distance and on any side, fewer if the map has fewer.
  std::span<const NearPoint> Nearest(const Point3& p, int k, Arena* arena) const;

  // Distance within which k photons are found around a typical photon: a high quantile over a fixed
  // sample of the photons. 0 for an empty map.
  Real TypicalRadius(int k, Arena* arena) const;

 private:
  void MeasureSpacing();
  // Squared radius in which k photons are to be expected round p; infinite where it is not known.
  Real ExpectedRadius2(const Point3& p, int k) const;
  template <class Set, class Measure>
  void SearchFrom(const Point3& p, int k, Real maxRadius2, Set* nearest, Measure&& measure) const;

  PointKdTree tree_;
  // Where searches begin: squared radius for each photon found, by the cells of one level.
  std::vector<Real> spacing2_;
  int spacingLevel_ = 0;
  std::vector<Vector3> directions_;  // in tree order
  std::vector<Spectrum> alphas_;
  std::int64_t paths_ = 0;
  Real minRadius_ = 0;  // what positions resolve
};

}  // namespace exphoton
