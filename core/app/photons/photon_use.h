// SPDX-License-Identifier: BSD-2-Clause
// MakePhotonFileUse prepares the use of a file of photons for one scene (--photons, exphoton
// photons).
#pragma once

#include <string>

#include "core/parser/render_setup.h"
#include "core/transport/photon_file_use.h"

namespace exphoton::cli {

// Reads the files that the scene names, to know their contents. Throws Error(CommandLine) if the
// integrator cannot keep photons.
PhotonFileUse MakePhotonFileUse(const std::string& path, bool isWritten, const LoadOptions& load,
                                const RenderSetup& setup);

}  // namespace exphoton::cli
