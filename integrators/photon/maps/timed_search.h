// SPDX-License-Identifier: BSD-2-Clause
// FindAt finds the photons of a density estimate at a time of the exposure. Photons of the whole
// exposure would show the mean of the light over time, which is wrong where light moves and is seen
// only for a part of the time. So where the photons around a point arrive unevenly over the
// exposure, a wider disk is searched, and only photons near the time count. The disk of a dim point
// then reaches farther into brighter light than before, so few photons have no windows. Source:
// Cammarano and Jensen 2002, "Time Dependent Photon Mapping".
#pragma once

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// The parts of the exposure that the test for evenness compares. No window is shorter.
inline constexpr int kExposureParts = 8;
// A map has windows of 1 / n of the exposure if it holds n k times this number of photons.
inline constexpr int kSearchesInMap = 16;

// Finds the photons of query.k, as PhotonMap::Find does if the map has no times or few photons, or
// if the photons around the point arrive evenly. Otherwise the disk is the one of n query.k
// photons, for windows of 1 / n of the exposure, and at most `widest` times query.maxDistance.
PhotonNeighbourhood FindAt(Real time, const PhotonMap& map, const PhotonQuery& query, Real widest,
                           Arena* arena);

}  // namespace exphoton
