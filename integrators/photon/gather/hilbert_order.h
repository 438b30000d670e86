// SPDX-License-Identifier: BSD-2-Clause
// HilbertOrder sorts photons so that similar directions lie close together. Stratified choices from
// the sorted photons are then stratified over directions. The map itself is not reordered. The
// order is only as fine as its cells of directions.
#pragma once

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// Returns the photons in the order in which a Hilbert curve visits the cells of their directions.
// Cells are about 13 degrees wide; photons of one cell keep their order. Uses the arena.
std::span<const std::uint32_t> HilbertOrder(const PhotonMap& map,
                                            std::span<const std::uint32_t> photons, Arena* arena);

}  // namespace exphoton
