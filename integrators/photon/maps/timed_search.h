// SPDX-License-Identifier: BSD-2-Clause
// FindAt finds the photons of a density estimate at a time of the exposure. Photons of the whole
// exposure would show the mean of the light over time, which is wrong where light moves and is seen
// only for a part of the time. So where the photons around a point arrive unevenly over the
// exposure, a wider disk is searched, and only photons near the time count. Time-dependent photon
// maps: Cammarano and Jensen 2002, "Time Dependent Photon Mapping".
#pragma once

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// The parts of the exposure that the test for evenness compares. Photons that are near in time lie
// within one of them.
inline constexpr int kExposureParts = 8;

// Finds the photons of query.k, as PhotonMap::Find does if the map has no times, or if the photons
// around the point arrive evenly. Otherwise the disk is the one of kExposureParts query.k photons.
PhotonNeighbourhood FindAt(Real time, const PhotonMap& map, const PhotonQuery& query, Arena* arena);

}  // namespace exphoton
