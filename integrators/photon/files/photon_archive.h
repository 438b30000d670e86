// SPDX-License-Identifier: BSD-2-Clause
// These functions save and load what files of photons and files of shares have in common.
#pragma once

#include "core/files/state_file.h"
#include "core/transport/photon_file_use.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

void Transfer(bool* flag, ByteArchive* archive);
void Transfer(LightTally* light, ByteArchive* archive);
// Loading throws ArchiveError if a number is not finite.
void Transfer(RadiancePhotonSite* site, ByteArchive* archive);

void WriteIdentity(const PhotonIdentity& identity, StateWriter* writer);
// Throws Error(CommandLine) if the file is of another identity, and Error(File) if it has none.
void CheckIdentity(const StateFile& file, const PhotonIdentity& identity);

}  // namespace exphoton
