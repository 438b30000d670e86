// SPDX-License-Identifier: BSD-2-Clause
// PhotonMap: the photons of one kind, ready to be searched, with their own path count N. An empty
// map is legal: everything about it is zero. Knows nothing of how photons were shot.
#pragma once

#include <span>
#include <vector>

#include "core/base/arena.h"
#include "core/spatial/point_tree.h"
#include "integrators/photon/maps/photon.h"

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
  // For irradiance: photons count by what a coat lets through at their angle, CoatTransmission.
  bool isCoated = false;
};

// The photons round a point: those whose kernel weight is not 0 by construction, in an order that
// follows from which they are.
struct PhotonNeighbourhood {
  std::span<const std::uint32_t> photons;
  std::span<const Real> distance2;  // of each
  Real radius2 = 0;                 // of the disk they stand for; > 0 if there are any
};

class PhotonMap {
 public:
  // A search region is flattened along the normal: a photon at height h counts as if it were at
  // least h / kFlatness away, which keeps corners and thin walls apart.
  static constexpr Real kFlatness = Real(.5);

  static constexpr double kBytesPerPhoton =
      PointTree<PhotonBlock>::kBytesPerPoint + double(sizeof(Real)) / PointTreeView::kSpacingPoints;

  PhotonMap() = default;
  PhotonMap(PhotonBuffer buffer, ThreadPool& threads)
      : PhotonMap(PointTree<PhotonBlock>(std::move(buffer.photons), threads), buffer, threads) {}
  // The tree: made from the buffer's photons.
  PhotonMap(PointTree<PhotonBlock> tree, const PhotonBuffer& buffer, ThreadPool& threads);

  bool IsEmpty() const { return tree_.Size() == 0; }
  std::size_t Size() const { return tree_.Size(); }
  std::int64_t Paths() const { return paths_; }
  Point3 Position(std::uint32_t i) const { return tree_.Position(i); }
  Vector3 Direction(std::uint32_t i) const { return tree_.Direction(i); }  // unit, to the light
  std::uint32_t DirectionCode(std::uint32_t i) const {                     // as EncodeOctahedral
    return tree_.BlockOf(i).direction[tree_.Lane(i)];
  }
  // Where the light of the photon was before, and came from straight or over mirrors: within 4.5 %
  // of its distance.
  Point3 Origin(std::uint32_t i) const {
    const Real part = DecodeDistance(OctahedralNote(DirectionCode(i)));
    return Position(i) + Direction(i) * (farthest_ * part);
  }
  Spectrum Alpha(std::uint32_t i) const { return tree_.BlockOf(i).Alpha(tree_.Lane(i)); }
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

  // The k nearest photons at any distance and on any side, by ascending index; fewer if the map has
  // fewer.
  NearPoints Nearest(const Point3& p, int k, Arena* arena) const;

  // Distance within which k photons are found around a typical photon: a high quantile over a fixed
  // sample of the photons. 0 for an empty map.
  Real TypicalRadius(int k, Arena* arena) const;

 private:
  PointTreeView View() const {
    PointTreeView view = tree_.View();
    view.spacing2 = spacing2_.data();
    return view;
  }

  PointTree<PhotonBlock> tree_;
  std::vector<Real> spacing2_;  // where searches begin
  std::int64_t paths_ = 0;
  Real farthest_ = 0;
  Real minRadius_ = 0;  // what positions resolve
};

}  // namespace exphoton
