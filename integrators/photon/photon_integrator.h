// SPDX-License-Identifier: BSD-2-Clause
// PhotonIntegrator: photon mapping in two passes, the surface integrator behind the plugins
// photonmap and exphotonmap, with different default settings. Preprocess shoots photons, builds the
// maps and computes the radiance photons; Li returns the radiance that leaves the visible surface
// towards the camera (docs/theory/exphotonmap.md, eq. 1).
#pragma once

#include <memory>

#include "core/lights/selection/light_sampler.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/integrator.h"
#include "core/transport/specular/specular_tree.h"
#include "integrators/photon/certificate/caustic_correction.h"
#include "integrators/photon/certificate/exact_radiance.h"
#include "integrators/photon/gather/final_gather.h"
#include "integrators/photon/maps/photon_map_set.h"
#include "integrators/photon/photon_budget.h"
#include "integrators/photon/photon_settings.h"
#include "integrators/photon/radiance/radiance_photon_map.h"

namespace exphoton {

class PhotonIntegrator final : public SurfaceIntegrator {
 public:
  explicit PhotonIntegrator(const PhotonSettings& settings);

  void Preprocess(const Scene& scene, PreprocessContext& context) override;
  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override;
  std::optional<int> EmissionDepth() const override {
    if (settings_.show != ShowMap::Nothing) return std::nullopt;
    return settings_.maxDepth;
  }
  bool HasCostlySamples() const override { return true; }
  int EdgeSamples() const override {
    return settings_.finalGather && settings_.show == ShowMap::Nothing ? settings_.edgeSamples : 1;
  }
  bool SharesGathers(const Scene& scene) const override {
    return settings_.sharedGather && GathersIndirectLight(settings_, scene);
  }
  Spectrum Li(const RayDifferential& ray, LiContext& context) const override;

  std::optional<CertificationLimits> Certification(const Scene& scene) const override;
  FeatureSet ComputedFeatures() const override;
  std::vector<std::string> Explain(const Scene& scene) const override;
  AovSet Aovs() const override;
  bool KeepsPhotons() const override { return true; }
  bool FillsSignedLight() const override { return settings_.show == ShowMap::Nothing; }
  std::vector<std::string> PhotonMapNames() const override;
  std::vector<StoredPhoton> PhotonsNear(const Point3& p, std::size_t map, int count) const override;

 private:
  // The stream of random numbers for the hits of gather rays ("rad" in ASCII).
  static constexpr std::uint64_t kGatherRayStream = 0x726164ull;

  // The steps of Preprocess.
  void BuildMaps(const Scene& scene, PhotonPassResult* photons, PreprocessContext& context);
  void ComputeRadiancePhotons(const Scene& scene, PhotonPassResult* photons,
                              PreprocessContext& context);

  // The terms of Li beside emission and specular light. Each is the radiance that the non-specular
  // lobes scatter towards wo.
  Spectrum Direct(const ShadingPoint& point, LiContext& context) const;
  Spectrum Caustic(const ShadingPoint& point, LiContext& context) const;
  Spectrum Indirect(const ShadingPoint& point, LiContext& context) const;
  // Returns the light of a map that is seen directly, and corrects the blur of its kernel, unless
  // rays correct it.
  Spectrum Seen(PhotonKind kind, const ShadingPoint& point, LiContext& context) const;

  // If the parameter "show" selects one map, Li is this instead: the light from that map, as the
  // term it belongs to, and no other light.
  SurfaceLight Shown(const ShadingPoint& point, LiContext& context) const;
  // Returns the radiance of the closest radiance photon.
  Spectrum ShownRadiance(const ShadingPoint& point) const;

  // Writes the AOV of photon density. Only the first hit of a camera ray counts.
  void FillDensity(const ShadingPoint& point, LiContext& context) const;

  PhotonSettings settings_;
  DirectLighting direct_;
  FinalGather gather_;
  PhotonGuide correctionGuide_;  // guides corrections even where it does not guide the gather
  bool gathers_ = false;         // whether indirect light is gathered; false: read from its map
  // Samples the direct light that glossy lobes reflect where gather rays hit.
  std::unique_ptr<const LightSampler> lights_;
  PhotonMapSet maps_;
  std::unique_ptr<const CausticCorrection> causticCorrection_;  // of the photons in maps_
  std::unique_ptr<RadiancePhotonMap> radianceMap_;              // null: no radiance photons
};

}  // namespace exphoton
