// SPDX-License-Identifier: BSD-2-Clause
// The integrator "exphotonmap" implements extended photon mapping, for scenes with mostly indirect
// light. It traces photons of nearly constant weight, precomputes radiance at a sample of the
// stored photons, and guides the final gather by photon directions. integrators/photon/ contains
// the implementation, docs/theory/exphotonmap.md the derivation.
#include "core/plugin.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/specular_tree.h"
#include "integrators/photon/photon_lighting.h"

namespace exphoton {
namespace {

const ParamTable<ExtendedPhotonSettings>& Parameters() {
  static const ParamTable<ExtendedPhotonSettings> table{PhotonParameters()};
  return table;
}

class ExPhotonIntegrator final : public SurfaceIntegrator {
 public:
  explicit ExPhotonIntegrator(const ExtendedPhotonSettings& settings)
      : settings_(settings), direct_(settings.directLights), photons_(settings, false) {}

  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    photons_.Preprocess(scene, context);
  }

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    direct_.RequestSamples(scene, sampler, layout);
    photons_.RequestSamples(scene, layout);
  }

  std::vector<std::string> Explain(const Scene& scene) const override {
    return photons_.Explain(scene);
  }

  AovSet Aovs() const override { return photons_.Aovs(); }

  std::vector<StoredPhoton> PhotonsNear(const Point3& p, const std::string& map,
                                        int count) const override {
    return photons_.PhotonsNear(p, map, count);
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    return SpecularTree(settings_.maxDepth, context).Radiance(ray, [&](const ShadingPoint& point) {
      if (settings_.show != ShowMap::Nothing)
        return photons_.Shown(point, context).Collect(point, context);
      photons_.Describe(point, context);
      return SurfaceLight{point.Le(), direct_.AllLights(point, context),
                          photons_.Caustic(point, context), photons_.Indirect(point, context)}
          .Collect(point, context);
    });
  }

 private:
  ExtendedPhotonSettings settings_;
  DirectLighting direct_;
  PhotonLighting photons_;
};

std::unique_ptr<SurfaceIntegrator> Create(const ExtendedPhotonSettings& settings,
                                          const IntegratorContext&) {
  return std::make_unique<ExPhotonIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_PLUGIN("exphotonmap", "extended photon mapping: precomputed radiance, guided final gather",
                exphoton::MakeForm<exphoton::PluginKind::Integrator>(exphoton::Parameters(),
                                                                     exphoton::Create))
