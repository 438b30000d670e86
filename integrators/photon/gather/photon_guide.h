// SPDX-License-Identifier: BSD-2-Clause
// PhotonGuide: the directions that some of a gather's rays keep close to: of the photons nearest to
// a point, those that come from where more light comes from than rays by the BSDF would look for.
// Camera samples of a pixel mostly see points so close together that one search serves them all; a
// gather is unbiased whatever guides it (docs/theory/exphotonmap.md, section 5).
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/cone.h"
#include "integrators/photon/gather/cone_directions.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

struct GuidedDirections {
  ConeDirections axes;  // in the order of a curve over the sphere; none: the BSDF does as well
  Real share = 0;       // that they are of the photons which light this side of the surface
};

class PhotonGuide {
 public:
  PhotonGuide() = default;  // none
  // By `count` photons and cones about them.
  PhotonGuide(int count, const Cone& cone) : count_(count), cone_(cone) {}

  // To be called when the map is there, which must outlive the pass.
  void Prepare(const PhotonMap& map);
  // Valid until the next call for this pixel.
  GuidedDirections Directions(const ShadingPoint& point, const PhotonMap& map,
                              LiContext& context) const;

 private:
  int count_ = 0;
  Cone cone_;
  Real cellWidth_ = 1;
};

}  // namespace exphoton
