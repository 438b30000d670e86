// SPDX-License-Identifier: BSD-2-Clause
// The photon budget of a render: how many photons each map wants in this scene, and the memory that
// they take. A map that nothing reads, or that the scene cannot fill, wants none.
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

// "100 direct, 200 indirect"; empty where no map wants a photon.
std::string TextOf(const PhotonTargets& targets);
// Bytes of the finished maps.
double BytesOf(const PhotonTargets& targets);
// Throws an Error of status Resource that names the targets and the memory limit.
[[noreturn]] void FailByMemory(const PhotonTargets& targets);

// Photons, gather and memory, one line each, for `exphoton explain`.
std::vector<std::string> ExplainBudget(const PhotonSettings& settings, const Scene& scene);

}  // namespace exphoton
