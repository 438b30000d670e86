// SPDX-License-Identifier: BSD-2-Clause
// PhotonGuide selects the directions that guide some rays of a gather. Of the photons nearest to a
// point, it keeps the ones whose directions carry more light than BSDF sampling would look for.
// Camera samples of a pixel mostly see nearby points, so they share one query. A gather is unbiased
// for any guide (docs/theory/exphotonmap.md, section 5).
#pragma once

#include <memory>

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/cone.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/gather/densities/direction_histogram.h"
#include "integrators/photon/gather/densities/photon_footprints.h"
#include "integrators/photon/gather/guide_table.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/photon_settings.h"

namespace exphoton {

struct GuidedDirections {
  ConeDirections axes;  // in Hilbert order; empty: BSDF sampling does as well
  Real share = 0;       // selected share of the photons that light this side of the surface
  Real irradiance = 0;  // luminance of the irradiance on this side, roughly, by all photons
  // The distribution that replaces the cones about the axes, if one is not null. The axes are all
  // photons that light this side then.
  const DirectionHistogram* histogram = nullptr;
  const PhotonFootprints* footprints = nullptr;
};

class PhotonGuide {
 public:
  PhotonGuide() = default;  // no guiding
  // Guides by `count` photons and cones about their directions.
  PhotonGuide(int count, const Cone& cone, GatherSampling kind = GatherSampling::Photons)
      : count_(count), cone_(cone), kind_(kind) {}

  // Guides by the photons of this map from now on, which must outlive the passes. Cells are kept
  // until the next call, so that all threads and all passes with these photons make a cell once.
  void Prepare(const PhotonMap& map);
  // Switches guiding off.
  void Clear() { cells_.reset(); }
  bool IsOn() const { return cells_ != nullptr; }

  // Returns no directions if guiding is off. The result is valid until the next call for this
  // pixel.
  GuidedDirections Directions(const ShadingPoint& point, LiContext& context) const;
  // The same for a vertex of a path, where guiding must be on. The result is valid until the arena
  // of the context is rewound.
  GuidedDirections DirectionsOnPath(const ShadingPoint& point, LiContext& context) const;

 private:
  // Returns what `follow` makes of the cell that contains p.
  template <class Follow>
  GuidedDirections WithCell(const Point3& p, LiContext& context, const Follow& follow) const;

  int count_ = 0;
  Cone cone_;
  GatherSampling kind_ = GatherSampling::Photons;
  std::unique_ptr<GuideTable> cells_;  // null: guiding is off
};

}  // namespace exphoton
