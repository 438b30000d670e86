// SPDX-License-Identifier: BSD-2-Clause
// GatherGuide: the directions that half of a gather's rays keep close to: those of the photons
// nearest to a point. Camera samples of a pixel mostly see points so close together that one search
// serves them all; a gather is unbiased whatever guides it (docs/exphotonmap.md, section 5).
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/cone_axes.h"
#include "integrators/photon/photon_map.h"

namespace exphoton {

class GatherGuide {
 public:
  // By `count` photons.
  explicit GatherGuide(int count = 0) : count_(count) {}

  // In the order of a curve over the sphere; none from where nothing can light this surface. Valid
  // until the next call for this pixel.
  ConeAxes Directions(const ShadingPoint& point, const PhotonMap& map, LiContext& context) const;

 private:
  int count_;
};

}  // namespace exphoton
