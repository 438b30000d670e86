// SPDX-License-Identifier: BSD-2-Clause
// Photons in an order that keeps those of like directions together, so that stratified choices from
// it are stratified over directions. No order of the photons themselves, and none that is exact.
#pragma once

#include "core/base/arena.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {

// The photons in the order in which a Hilbert curve passes the cells, about 13 degrees wide, of
// their directions; those of one cell as given. Lies in the arena.
std::span<const std::uint32_t> HilbertOrder(const PhotonMap& map,
                                            std::span<const std::uint32_t> photons, Arena* arena);

}  // namespace exphoton
