// SPDX-License-Identifier: BSD-2-Clause
// PhotonLighting: the two passes of photon mapping as an integrator sees them: Preprocess shoots
// and builds what the scene calls for, then each term of the radiance equation is one call. Holds
// what one render needs, and nothing from an earlier one.
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
  // needsDirectMap: the integrator itself reads the direct map.
  PhotonLighting(const PhotonSettings& settings, bool needsDirectMap)
      : settings_(settings), needsDirectMap_(needsDirectMap) {}

  void Preprocess(const Scene& scene, PreprocessContext& context);
  void RequestSamples(const Scene& scene, SampleLayout* layout);
  // The maps that this scene calls for and the memory that they will take.
  std::vector<std::string> Explain(const Scene& scene) const;

  // Radiance by the non-specular lobes towards wo:
  Spectrum Direct(const ShadingPoint& point, LiContext& context) const;   // of the direct map
  Spectrum Caustic(const ShadingPoint& point, LiContext& context) const;  // of the caustic map
  // Gathered over the hemisphere, or of the indirect map where final gathering is off.
  Spectrum Indirect(const ShadingPoint& point, LiContext& context) const;
  // The map that `show` names and nothing else.
  SurfaceLight Shown(const ShadingPoint& point, LiContext& context) const;

  // The layers that Li and its terms fill.
  AovSet Aovs() const;
  // Fills the density of photons at the camera's own surface, where that layer is wanted.
  void Describe(const ShadingPoint& point, LiContext& context) const;
  // As SurfaceIntegrator::PhotonsNear.
  std::vector<StoredPhoton> PhotonsNear(const Point3& p, const std::string& map, int count) const;

 private:
  static constexpr std::uint64_t kGatherStream = 0x726164ull;

  Spectrum ShownRadiance(const ShadingPoint& point) const;  // of the radiance photons
  bool Gathers(const Scene& scene) const;
  std::string GatherText(const Scene& scene, const PhotonTargets& targets) const;
  PhotonTargets Targets(const Scene& scene) const;
  // Where far lights should shoot; empty: everywhere.
  DistantLightTargeting Aim(const Scene& scene, const PhotonTargets& targets,
                            PreprocessContext& context) const;
  void Build(const Scene& scene, const PhotonTargets& targets, PreprocessContext& context);

  PhotonSettings settings_;
  bool needsDirectMap_;
  LightSampler lights_;  // for what gather rays meet
  PhotonMapSet maps_;
  std::unique_ptr<RadiancePhotonMap> radianceMap_;
  FinalGather gather_;
  bool gathers_ = false;
};

}  // namespace exphoton
