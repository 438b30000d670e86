// SPDX-License-Identifier: BSD-2-Clause
// ShootPhotons is the photon pass of all integrators that use photons.
#pragma once

#include "core/transport/integrator.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Shoots until the maps hold the target counts, and reports what was shot and stored. If the
// context names a file of photons, they are read from it instead, or written to it. Throws
// PhotonsWritten once they are written.
PhotonPassResult ShootPhotons(const Scene& scene, const PhotonSettings& settings,
                              const PhotonTargets& targets, PreprocessContext& context);

}  // namespace exphoton
