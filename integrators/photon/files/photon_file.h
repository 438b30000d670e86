// SPDX-License-Identifier: BSD-2-Clause
// These functions keep the result of a photon pass in a file and read it again. The photons lie in
// the file as they lie in memory, so that processes on one machine share their pages. A read pass
// gives the same maps, bit for bit, as the pass that was written.
// docs/development/state-files.md describes the format.
#pragma once

#include "core/transport/integrator.h"
#include "core/transport/photon_file_use.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Returns all that the photons depend on: the identity of the scene, and the settings.
PhotonIdentity IdentityOfPhotons(const PhotonIdentity& scene, const PhotonSettings& settings,
                                 const PhotonTargets& targets, std::uint64_t seed);

// Writes the file and sorts the photons. Throws Error(File).
void WritePhotons(const std::string& path, const PhotonIdentity& identity,
                  PhotonPassResult* photons, ThreadPool& threads);

// Throws Error(File) if the file cannot be read, is damaged or is of another kind, and
// Error(CommandLine) if it is of another identity. The text names everything that differs.
PhotonPassResult ReadPhotons(const std::string& path, const PhotonIdentity& identity);

}  // namespace exphoton
