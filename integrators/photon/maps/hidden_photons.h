// SPDX-License-Identifier: BSD-2-Clause
// Estimates of density leave out photons that a wall hides from their point, so that light does not
// leak through walls. Only photons on or before the tangent plane can be hidden. Those behind it
// lie round the edge of a solid, and stand for the part of the disk that extends over the edge.
// Most points have no wall in their disk, so the others are only tested where a photon before the
// plane is hidden.
#pragma once

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/maps/walls.h"

namespace exphoton {

// The photons of an estimate that its point sees.
struct SeenPhotons {
  PhotonNeighbourhood around;  // radius2 is the one of all photons
  bool isBesideWall = false;   // a wall stands in the disk, and the surface goes on behind it
};

// Tests a few photons before the plane, and all photons if one of these is hidden. The photon at
// the largest angle over the plane may lie on a wall that hides nothing because its other side is
// dark.
SeenPhotons WithoutHidden(const PhotonMap& map, const PhotonQuery& query,
                          const PhotonNeighbourhood& around, const Walls& walls, Arena* arena);

// Tests one photon before the plane, chosen at random by the point. If it is hidden, all photons
// before the plane are left out, so the mean over many points counts the right share of them. The
// photons on the plane are then tested in the same way. This takes at most two rays.
PhotonNeighbourhood ProbablySeen(const PhotonMap& map, const PhotonQuery& query,
                                 const PhotonNeighbourhood& around, const Walls& walls,
                                 Arena* arena);

}  // namespace exphoton
