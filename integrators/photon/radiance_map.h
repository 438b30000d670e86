// SPDX-License-Identifier: BSD-2-Clause
// RadianceMap: exitant radiance (or irradiance) precomputed at a sample of the stored photons, read
// by gather rays. Christensen 1999, "Faster Photon Map Global Illumination".
#pragma once

#include <optional>
#include <vector>

#include "core/spatial/nearest_cells.h"
#include "integrators/photon/photon_maps.h"

namespace exphoton {

class RadianceMap {
 public:
  struct Entry {
    Normal3 n;        // unit geometric normal of the side that it speaks for
    Spectrum value;   // Exitant: radiance leaving on that side; Irradiance: arriving on it
    Real radius = 0;  // of its estimate
  };

  static constexpr std::size_t kBytesPerEntry =
      sizeof(Point3) + sizeof(std::uint32_t) + sizeof(Entry) + NearestCells::kTypicalBytesPerPoint;

  RadianceMap() = default;  // empty: finds nothing
  // Computes all entries in parallel (docs/exphotonmap.md, eq. 13): Lo = rho_r / pi E(p, n) + rho_t
  // / pi E(p, -n), and for the other side too where something is transmitted. Without
  // needsTransmission (Effect::Transmission) rho_t counts as 0.
  RadianceMap(const std::vector<RadianceSeed>& seeds, const PhotonMaps& maps,
              const PhotonSettings& settings, bool needsTransmission, PreprocessContext& context);

  std::size_t Size() const { return tree_.Size(); }
  std::size_t MemoryBytes() const;

  // Where to look for what serves p. Null: nowhere in particular. The cell is on its way to the
  // cache then, and after Prefetch what the cell lists.
  using Place = const NearestCells::Cell*;
  Place Locate(const Point3& p) const {
    const Place place = cells_.Around(p);
    if (place) NearestCells::Prefetch(*place);
    return place;
  }
  void Prefetch(Place place) const {
    if (place) cells_.PrefetchListed(*place);
  }
  // The nearest entry that speaks for a surface point p with unit normal n (turned towards where
  // the radiance goes): its normal agrees and p lies within its reach (eq. 14). Null where there is
  // none. place: Locate(p).
  const Entry* Find(const Point3& p, const Normal3& n, Place place) const;
  // How far an entry that Find gave lies from a point.
  Real DistanceTo(const Entry& entry, const Point3& p) const {
    return Distance(tree_.Point(std::uint32_t(&entry - entries_.data())), p);
  }

 private:
  bool Serves(std::uint32_t i, Real distance2, const Normal3& n) const {
    const Entry& entry = entries_[i];
    return distance2 <= Square(reach_ * entry.radius) && Dot(entry.n, n) > minCosine_;
  }
  // The nearest listed entry that serves; kInfinity and no index where none does.
  NearPoint NearestListed(const NearestCells::Cell& cell, const Point3& p, const Normal3& n) const;

  PointKdTree tree_;
  NearestCells cells_;
  std::vector<Entry> entries_;  // in tree order
  Real minCosine_ = 0;
  Real reach_ = 0;      // an entry serves within so many of its radii
  Real maxReach2_ = 0;  // squared reach of any entry
};

}  // namespace exphoton
