// SPDX-License-Identifier: BSD-2-Clause
// Estimates of density leave out photons that a wall hides from their point, so that light does not
// leak through walls. Photons behind the tangent plane may lie round the edge of a solid, where
// they replace the part of the disk that extends over the edge. A wall hides them only if it blocks
// a way round this edge too. Most points have no wall in their disk, so all photons are tested only
// where one before the plane is hidden, or one behind it if there are none before it. Small objects
// hide photons too, but light is alike on both of their sides. So hidden photons count like the
// seen ones, up to the same number.
#pragma once

#include <cstdint>
#include <span>

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"
#include "integrators/photon/maps/walls.h"

namespace exphoton {

struct SeenPhotons {
  PhotonNeighbourhood around;             // radius2 is the one of all photons
  std::span<const std::uint32_t> before;  // photons before the plane, hidden or not; in the arena
  bool areSomeHidden = false;
};

// Returns the photons that the point sees. Tests up to four photons before the plane, or behind it
// if there are none, and all photons if one of these is hidden. Hidden photons count like the seen
// ones, up to the same number: `share` of the result is the share of the seen photons, but at least
// a half.
SeenPhotons WithoutHidden(const PhotonMap& map, const PhotonQuery& query,
                          const PhotonNeighbourhood& around, const Walls& walls, Arena* arena);

// Tests one photon before the plane, or behind it if there are none, chosen at random by the point.
// If it is hidden, tests two of all photons, and leaves all of them out if both are hidden. If a
// share h of all layers is hidden, the light of a share 1 - h^3 counts in the mean over many
// points.
PhotonNeighbourhood ProbablySeen(const PhotonMap& map, const PhotonQuery& query,
                                 const PhotonNeighbourhood& around, const Walls& walls,
                                 Arena* arena);

// Returns whether a wall crosses the disk: some photons are hidden, or the surface of the point
// goes on behind the photon at the largest angle over the plane. The second test finds walls whose
// other side is dark, because no photons are hidden there.
bool IsBesideWall(const PhotonMap& map, const PhotonQuery& query, const SeenPhotons& seen,
                  const Walls& walls);

}  // namespace exphoton
