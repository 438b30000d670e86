// SPDX-License-Identifier: BSD-2-Clause
// PhotonMap stores the photons of one kind with the number N of traced paths, and finds the photons
// near a point. An empty map is legal: all its results are zero. The class does not depend on how
// photons are traced.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "core/base/arena.h"
#include "core/spatial/nearest_search.h"
#include "integrators/photon/maps/photon.h"
#include "integrators/photon/maps/photon_time.h"
#include "integrators/photon/maps/walls.h"

namespace exphoton {

// PhotonQuery is a k-nearest-neighbours query for photons.
struct PhotonQuery {
  Point3 p;
  Normal3 n;             // unit geometric normal of the receiver
  int k = 50;            // >= 2
  Real maxDistance = 0;  // > 0
  // If true, only photons that arrived on n's side count. The search applies this test, so photons
  // on the far side of a thin wall neither add light nor shrink the radius.
  bool isOneSided = true;
  // For irradiance: each photon is weighted by CoatTransmission at its angle of incidence.
  bool isCoated = false;
  double diskArea = 1;  // of the disk, relative to the one that k and maxDistance give; in (0,1]
  // For irradiance: each photon is weighted by the ratio of its cosines to these normals.
  ShadingNormals normals = {};
};

// PhotonNeighbourhood holds the photons of one density estimate. If k photons are found, the k-th
// only gives the radius and is left out. The order depends only on the set of photons, so that sums
// are deterministic.
struct PhotonNeighbourhood {
  std::span<const std::uint32_t> photons;
  std::span<const Real> distance2;  // one per photon
  Real radius2 = 0;                 // of the estimation disk; > 0 if there are photons
  // With a diskArea below 1, photons beyond the disk are in the list too.
  // The ratio of these photons to all photons that count. It is the part of the exposure in which
  // they arrived (timed_search.h), times the share of the seen photons (hidden_photons.h).
  Real share = 1;
};

class PhotonMap {
 public:
  // The search region is flattened along the normal. A photon at height h over the tangent plane
  // counts as if its distance were at least h / kFlatness (eq. 11). This excludes most photons of
  // other surfaces at corners and thin walls.
  static constexpr Real kFlatness = Real(.5);
  // Rounding changes this distance by less than this part of it
  // (tests/proofs/flattened_distance.gappa).
  static constexpr Real kFlattenedError = Gamma(32);

  static constexpr double kBytesPerPhoton =
      PointTree<PhotonBlock>::kBytesPerPoint + double(sizeof(Real)) / PointTreeView::kSpacingPoints;

  PhotonMap() = default;
  PhotonMap(PhotonBuffer buffer, ThreadPool& threads)
      : PhotonMap(PointTree<PhotonBlock>(std::move(buffer.photons), threads), buffer, threads) {}
  // `tree` is built from the buffer's photons.
  PhotonMap(PointTree<PhotonBlock> tree, const PhotonBuffer& buffer, ThreadPool& threads);

  bool IsEmpty() const { return tree_.Size() == 0; }
  std::size_t Size() const { return tree_.Size(); }
  std::int64_t Paths() const { return paths_; }
  Point3 Position(std::uint32_t i) const { return tree_.Position(i); }
  Vector3 Direction(std::uint32_t i) const { return tree_.Direction(i); }  // unit, to the light
  std::uint32_t DirectionCode(std::uint32_t i) const {                     // as EncodeOctahedral
    return tree_.BlockOf(i).direction[tree_.Lane(i)];
  }
  // Returns whether photons know when they arrived.
  bool HasTimes() const { return exposure_.min < exposure_.max; }
  Interval Exposure() const { return exposure_; }
  // Returns the time of the photon, in [0,1] of the exposure. The map must have times.
  Real PartOfExposure(std::uint32_t i) const {
    return DecodePhotonTime(OctahedralPayload(DirectionCode(i)));
  }
  // Returns the apparent origin of the photon: the point along its direction at its path length
  // since the emission or the last non-specular scattering. The distance is within 4.5 %. In a map
  // with times the origin is far away.
  Point3 Origin(std::uint32_t i) const {
    const Real part = HasTimes() ? 1 : DecodeDistance(OctahedralPayload(DirectionCode(i)));
    return Position(i) + Direction(i) * (farthest_ * part);
  }
  Spectrum Alpha(std::uint32_t i) const { return tree_.BlockOf(i).Alpha(tree_.Lane(i)); }
  Real Sign(std::uint32_t i) const { return tree_.BlockOf(i).Sign(tree_.Lane(i)); }
  std::size_t MemoryBytes() const;

  // Finds the k nearest photons within maxDistance. If there are k, the farthest is left out and
  // gives the radius. If there are fewer, all count and the radius is maxDistance. For photons of
  // constant density on a plane the combined estimate is unbiased (eq. 9). If all k photons
  // coincide, all of them count and the radius is the rounding error of positions.
  PhotonNeighbourhood Find(const PhotonQuery& query, Arena* arena) const;

  // The disk of a single photon is the one that is expected to hold kOwnDisk * k photons.
  static constexpr double kOwnDisk = .6;

  // Estimates the irradiance on the side of n, sum(alpha_i / (pi r_i^2)) / N over the k nearest
  // photons whose own disk of radius r_i reaches p. A disk follows from the photon's surroundings,
  // and is at most the disk of Find. It keeps dense light together, where the disk of a dark point
  // would spread it (docs/decisions/0108-disks-of-photons.md).
  struct Irradiance {
    Spectrum e;        // without photons at p itself
    Spectrum signedE;  // the same, in which each photon has its sign
    Spectrum own;      // of photons at p itself
    Spectrum signedOwn;
    double ownDisk2 = 0;  // squared radius of their disks
    double density = 0;   // other photons in a disk whose squared radius is 1
    Real radius = 0;      // of Find, at most the one of k photons as dense as in the largest disk
    bool isBesideWall = false;  // IsBesideWall in hidden_photons.h
  };
  // `walls` hide photons (hidden_photons.h).
  Irradiance EstimateIrradiance(const PhotonQuery& query, Arena* arena,
                                const Walls& walls = Walls()) const;

  // Finds the k nearest photons at any distance and on any side; all photons if the map has fewer.
  // The result is ordered by ascending index.
  NearPoints Nearest(const Point3& p, int k, Arena* arena) const;

  // Returns the distance within which 90 % of the photons have k neighbours, estimated from a fixed
  // sample of the photons. 0 for an empty map. In a guided map, photons much heavier than most are
  // left out: they lie where the guide expected none.
  Real TypicalRadius(int k, Arena* arena) const;

 private:
  PointTreeView View() const {
    PointTreeView view = tree_.View();
    view.spacing2 = spacing2_.data();
    return view;
  }

  Real WeightOf(const PhotonQuery& query, std::uint32_t i) const;
  // Returns the squared radius of the disk that holds this many photons, in multiples of the
  // spacing, or infinity if it is not known.
  Real OwnDisk2(std::uint32_t i, Real spacings) const;
  Real SmallestRadius2() const {
    return std::max(Square(minRadius_), std::numeric_limits<Real>::min());
  }

  PointTree<PhotonBlock> tree_;
  std::vector<Real> spacing2_;  // local squared spacing; speeds up searches, and makes own disks
  std::int64_t paths_ = 0;
  bool isGuided_ = false;
  Real farthest_ = 0;
  Interval exposure_{0, 0};  // PhotonBuffer::times
  Real minRadius_ = 0;       // rounding error of the positions
};

}  // namespace exphoton
