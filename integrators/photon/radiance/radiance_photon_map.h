// SPDX-License-Identifier: BSD-2-Clause
// RadiancePhotonMap stores the exitant radiance of diffuse lobes, precomputed at a sample of the
// stored photons, and finds the radiance photon that is valid for a hit of a gather ray. Source:
// Christensen 1999, "Faster Photon Map Global Illumination".
#pragma once

#include <optional>
#include <vector>

#include "core/scattering/bxdf.h"
#include "core/spatial/nearest_search.h"
#include "core/spatial/search_start.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/radiance/packed_radiance.h"
#include "integrators/photon/radiance/packed_ratios.h"

namespace exphoton {

// RadianceRecord stores a radiance photon in 36 bytes. Its normal is within 7e-5 radians of the
// surface's normal.
struct RadianceRecord {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral of the normal on the valid side
  Real radius2 = 0;             // squared validity radius
  // Radiance that the diffuse lobes scatter to that side. On a coated surface it includes the
  // coat's transmission on the way in. Entry::Value applies the transmission on the way out.
  PackedRadiance value;
  PackedRatios signedRatios;  // of the value with the sign of each photon
  bool isBesideWall = false;  // PhotonMapSet::Irradiance
};

struct RadianceBlock : DiskBlock {
  using Record = RadianceRecord;

  PackedRadiance value[kBlockPoints];  // only read for single lanes
  PackedRatios signedRatios[kBlockPoints];
  bool isBesideWall[kBlockPoints];
  void Set(std::uint32_t lane, const RadianceRecord& record) {
    PointBlock::Set(lane, {record.p, record.direction});
    radius2[lane] = record.radius2;
    value[lane] = record.value;
    signedRatios[lane] = record.signedRatios;
    isBesideWall[lane] = record.isBesideWall;
  }
};

class RadiancePhotonMap {
 public:
  // The radiance photon that is valid for a surface point.
  struct Entry {
    PackedRadiance packed;
    PackedRatios signedRatios;
    Real radius2 = 0;    // squared radius of its density estimate
    Real distance2 = 0;  // squared distance from the point
    bool isBesideWall = false;
    Point3 p;  // of the radiance photon

    // Returns the exitant radiance. absCos: absolute cosine between the normal and the viewing
    // direction.
    Spectrum Value(Real absCos) const {
      const Spectrum value = packed.Radiance();
      return packed.IsCoated() ? value * CoatTransmission(absCos) : value;
    }
    // Returns the same with the sign of each photon (signed_power.h).
    Spectrum SignedValue(Real absCos) const { return signedRatios.PartOf(Value(absCos)); }
  };

  static constexpr std::size_t kGridCellsPerEntry = 2;
  static constexpr double kBytesPerEntry =
      PointTree<RadianceBlock>::kBytesPerPoint + double(kGridCellsPerEntry * sizeof(std::uint32_t));

  RadiancePhotonMap() = default;  // empty: Find returns nothing
  // Computes all entries in parallel: Lo = rho_r / pi E(p, n) + rho_t / pi E(p, -n) for the diffuse
  // lobes (docs/theory/exphotonmap.md, eq. 13). A transmitting surface gets a second entry for its
  // other side. Without needsTransmission (Feature::Transmission), rho_t counts as 0. The
  // constructor reorders the sites.
  RadiancePhotonMap(std::span<RadiancePhotonSite> sites, const PhotonMapSet& maps,
                    const PhotonSettings& settings, bool needsTransmission,
                    PreprocessContext& context);

  std::size_t Size() const { return tree_.Size(); }
  std::size_t MemoryBytes() const { return tree_.MemoryBytes() + grid_.MemoryBytes(); }

  // Finds the nearest entry that is valid for a surface point p with unit normal n, turned to the
  // side that the radiance leaves on: the normals agree, and p lies within the validity radius (eq.
  // 14). Searching many places in one call takes less time per place.
  using Place = ClosestQuery;
  void Find(std::span<const Place> places, std::optional<Entry>* found) const;
  std::optional<Entry> Find(const Place& place) const {
    std::optional<Entry> found;
    Find({&place, 1}, &found);
    return found;
  }

 private:
  PointTreeView View() const {
    PointTreeView view = tree_.View();
    view.grid = &grid_;
    return view;
  }

  PointTree<RadianceBlock> tree_;
  EntryGrid grid_;  // entry points of lookups
  Real minCosine_ = 0;
  Real reach_ = 0;  // ratio of the validity radius to the radius of the entry's density estimate
  Real maxRadius2_ = 0;  // largest squared validity radius
};

}  // namespace exphoton
