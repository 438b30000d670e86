// SPDX-License-Identifier: BSD-2-Clause
// These functions keep one share of the photons (chunk_memo.h) in a file.
#pragma once

#include <string>
#include <vector>

#include "core/transport/photon_file_use.h"
#include "integrators/photon/shooting/chunk_memo.h"

namespace exphoton {

// Throws Error(File).
void WritePhotonPart(const std::string& path, const PhotonIdentity& identity, ChunkMemo* memo);

// Adds the chunks of a file to the memo. Throws as ReadPhotons does. `lights` is the number of
// lights in the scene.
void ReadPhotonPart(const std::string& path, const PhotonIdentity& identity, std::size_t lights,
                    ChunkMemo* memo);

}  // namespace exphoton
