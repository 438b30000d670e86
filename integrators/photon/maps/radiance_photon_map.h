// SPDX-License-Identifier: BSD-2-Clause
// RadiancePhotonMap: exitant radiance (or irradiance) precomputed at a sample of the stored
// photons, read by gather rays. Christensen 1999, "Faster Photon Map Global Illumination".
#pragma once

#include <optional>
#include <vector>

#include "core/scattering/bxdf.h"
#include "core/spatial/point_tree.h"
#include "integrators/photon/maps/packed_radiance.h"
#include "integrators/photon/maps/photon_map_set.h"

namespace exphoton {

// A radiance photon of 32 bytes. Its normal is within 7e-5 radians of the surface's.
struct RadianceRecord {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral, of the normal on the side that it speaks for
  Real reach2 = 0;              // it serves within this squared distance
  // Exitant: radiance leaving on that side by the diffuse lobes; Irradiance: arriving on it. Of a
  // coated surface each photon counts by CoatTransmission.
  PackedRadiance value;
};

struct RadianceBlock : DiskBlock {
  using Record = RadianceRecord;

  PackedRadiance value[kBlockPoints];  // read one by one
  void Set(std::uint32_t lane, const RadianceRecord& record) {
    PointBlock::Set(lane, {record.p, record.direction});
    reach2[lane] = record.reach2;
    value[lane] = record.value;
  }
};

class RadiancePhotonMap {
 public:
  // What serves a surface point.
  struct Entry {
    PackedRadiance packed;
    Real radius2 = 0;    // squared, of its estimate
    Real distance2 = 0;  // squared, from the point

    // The radiance or irradiance, seen at an angle to the normal.
    Spectrum Value(Real absCos) const {
      const Spectrum value = packed.Radiance();
      return packed.IsCoated() ? value * CoatTransmission(absCos) : value;
    }
  };

  static constexpr std::size_t kGridCellsPerEntry = 2;
  static constexpr double kBytesPerEntry =
      PointTree<RadianceBlock>::kBytesPerPoint + double(kGridCellsPerEntry * sizeof(std::uint32_t));

  RadiancePhotonMap() = default;  // empty: finds nothing
  // Computes all entries in parallel (docs/theory/exphotonmap.md, eq. 13): Lo = rho_r / pi E(p, n)
  // + rho_t / pi E(p, -n), of the diffuse lobes, and for the other side too where something is
  // transmitted. Without needsTransmission (Feature::Transmission) rho_t counts as 0. Sites are put
  // into another order.
  RadiancePhotonMap(std::span<RadiancePhotonSite> sites, const PhotonMapSet& maps,
                    const PhotonSettings& settings, bool needsTransmission,
                    PreprocessContext& context);

  std::size_t Size() const { return tree_.Size(); }
  std::size_t MemoryBytes() const { return tree_.MemoryBytes() + grid_.MemoryBytes(); }

  // The nearest entry that speaks for a surface point p with unit normal n (turned towards where
  // the radiance goes): its normal agrees and p lies within its reach (eq. 14). Many at once take
  // less time each.
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
  EntryGrid grid_;  // where lookups begin
  Real minCosine_ = 0;
  Real reach_ = 0;      // an entry serves within so many radii of its estimate
  Real maxReach2_ = 0;  // squared reach of any entry
};

}  // namespace exphoton
