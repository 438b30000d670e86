// SPDX-License-Identifier: BSD-2-Clause
// What people are told of a photon pass: shortages, cut power, dropped photons, chosen radii, and
// the counters of --stats.
#pragma once

#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/maps/radiance_photon_map.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Caustic photons that the file asks for in so many words, where the plan has no caustics.
void NoticeVainCaustics(const PhotonTargets& targets, const PhotonSettings& settings,
                        const Scene& scene, Log& log);
// Where photons of far lights are aimed.
void ReportAim(const DistantLightTargeting& aim, PreprocessContext& context);
// That an aim would be worth its while where there is none.
void NoticeUnaimed(const DistantLightTargeting& aim, Log& log);
// Once the photons are shot, while their buffers are still in the result.
void ReportPhotonPass(const PhotonPassResult& result, const PhotonTargets& targets,
                      const PhotonSettings& settings, PreprocessContext& context);
// The table of photons by light, and the lights that shot in vain.
void ReportLights(const PhotonPassResult& result, const PhotonTargets& targets, const Scene& scene,
                  PreprocessContext& context);
// Once the maps are built. radianceMap may be null.
void ReportMaps(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
                const PhotonSettings& settings, PreprocessContext& context);

}  // namespace exphoton
