// SPDX-License-Identifier: BSD-2-Clause
// This header computes the photon budget of a render: the target count of each map in this scene,
// and the memory of the finished maps. The target is 0 for a map that no estimate reads or that the
// scene cannot fill.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Whether indirect light is gathered over the hemisphere in this scene.
bool GathersIndirectLight(const PhotonSettings& settings, const Scene& scene);

PhotonTargets ChooseTargets(const PhotonSettings& settings, const Scene& scene);

// Returns text like "100 direct, 200 indirect". It is empty if all targets are 0.
std::string TextOf(const PhotonTargets& targets);
// Returns the estimated size of the finished maps, radiance photons included. Building them takes
// more.
double BytesOf(const PhotonTargets& targets);
// Throws an Error of status Resource that names the targets and the memory limit.
[[noreturn]] void FailByMemory(const PhotonTargets& targets);

// Returns one line each on photons, final gather, memory and emission, for `exphoton explain`.
std::vector<std::string> ExplainBudget(const PhotonSettings& settings, const Scene& scene);

}  // namespace exphoton
