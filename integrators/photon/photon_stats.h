// SPDX-License-Identifier: BSD-2-Clause
// These functions report on the photon pass: maps that were not filled, power cut by the depth
// limit, dropped photons, chosen radii, and the counters of --stats.
#pragma once

#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/radiance/radiance_photon_map.h"
#include "integrators/photon/shooting/photon_tracer.h"

namespace exphoton {

// Logs a notice if the scene file sets causticphotons although feature culling excludes caustics.
void NoticeUnusedCaustics(const PhotonTargets& targets, const PhotonSettings& settings,
                          const Scene& scene, Log& log);
// Reports that photons of distant lights are targeted, and the gain.
void ReportTargeting(const DistantLightTargeting& targeting, PreprocessContext& context);
// Logs a notice that targeting is off although it would be worthwhile.
void NoticeMissingTargeting(const DistantLightTargeting& targeting, Log& log);
// To be called after tracing, while the result still holds the photon buffers.
void ReportPhotonPass(const PhotonPassResult& result, const PhotonTargets& targets,
                      const PhotonSettings& settings, PreprocessContext& context);
// Reports photons that were read from a file.
void ReportReadPhotons(const PhotonPassResult& result, const std::string& path,
                       PreprocessContext& context);
// Reports the photons per light, and logs notices about lights whose photons were never stored.
void ReportLights(const PhotonPassResult& result, const PhotonTargets& targets, const Scene& scene,
                  PreprocessContext& context);
// To be called after the maps are built. radianceMap may be null.
void ReportMaps(const PhotonMapSet& maps, const RadiancePhotonMap* radianceMap,
                const PhotonSettings& settings, PreprocessContext& context);

}  // namespace exphoton
