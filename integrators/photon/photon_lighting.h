// SPDX-License-Identifier: BSD-2-Clause
// PhotonLighting implements the two passes of photon mapping for the surface integrators.
// Preprocess traces the photons and builds the maps that the scene needs. Afterwards each
// photon-based term of the radiance equation (docs/theory/exphotonmap.md, eq. 1) is one call. The
// object holds the state of one render only.
#pragma once

#include <memory>

#include "core/transport/integrator.h"
#include "core/transport/light_sampler.h"
#include "core/transport/specular_tree.h"
#include "integrators/photon/gather/final_gather.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/maps/radiance_photon_map.h"
#include "integrators/photon/shooting/distant_light_targeting.h"

namespace exphoton {

class PhotonLighting {
 public:
  // needsDirectMap: the integrator reads the direct map at camera hits.
  PhotonLighting(const PhotonSettings& settings, bool needsDirectMap)
      : settings_(settings), needsDirectMap_(needsDirectMap) {}

  void Preprocess(const Scene& scene, PreprocessContext& context);
  void RequestSamples(const Scene& scene, SampleLayout* layout);
  // Describes the maps that this scene needs, and their memory.
  std::vector<std::string> Explain(const Scene& scene) const;

  // These return the radiance that the non-specular lobes scatter towards wo.
  Spectrum Direct(const ShadingPoint& point, LiContext& context) const;   // from the direct map
  Spectrum Caustic(const ShadingPoint& point, LiContext& context) const;  // from the caustic map
  // By final gathering, or from the indirect map if final gathering is off.
  Spectrum Indirect(const ShadingPoint& point, LiContext& context) const;
  // Returns only the light of the map that the parameter `show` names.
  SurfaceLight Shown(const ShadingPoint& point, LiContext& context) const;

  // The AOVs that Li and its terms fill.
  AovSet Aovs() const;
  // Fills the photon density AOV at the camera ray's hit, if that AOV is requested.
  void Describe(const ShadingPoint& point, LiContext& context) const;
  // Implements SurfaceIntegrator::PhotonsNear.
  std::vector<StoredPhoton> PhotonsNear(const Point3& p, const std::string& map, int count) const;

 private:
  static constexpr std::uint64_t kGatherStream = 0x726164ull;

  Spectrum ShownRadiance(const ShadingPoint& point) const;  // from the radiance photons
  bool Gathers(const Scene& scene) const;
  std::string GatherText(const Scene& scene, const PhotonTargets& targets) const;
  PhotonTargets Targets(const Scene& scene) const;
  // Returns the emission sampling of distant lights; empty: photons start everywhere.
  DistantLightTargeting Aim(const Scene& scene, const PhotonTargets& targets,
                            PreprocessContext& context) const;
  void Build(const Scene& scene, const PhotonTargets& targets, PreprocessContext& context);

  PhotonSettings settings_;
  bool needsDirectMap_;
  LightSampler lights_;  // next event estimation at hits of gather rays
  PhotonMapSet maps_;
  std::unique_ptr<RadiancePhotonMap> radianceMap_;
  FinalGather gather_;
  bool gathers_ = false;
};

}  // namespace exphoton
