// SPDX-License-Identifier: BSD-2-Clause
// The integrator "photonmap" implements photon mapping with final gathering as Jensen (2001)
// describes it. It is the baseline for exphotonmap and shares its implementation in
// integrators/photon/. Each improvement of exphotonmap can be switched on here too.
#include "core/plugin.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/specular_tree.h"
#include "integrators/photon/photon_lighting.h"

namespace exphoton {
namespace {

struct Settings : PhotonSettings {
  bool directWithPhotons = false;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      PhotonParameters(), Param("directwithphotons", &Settings::directWithPhotons,
                                "direct light from the direct photon map instead of shadow rays")};
  return table;
}

class PhotonIntegrator final : public SurfaceIntegrator {
 public:
  explicit PhotonIntegrator(const Settings& settings)
      : settings_(settings),
        direct_(settings.directLights),
        photons_(settings, settings.directWithPhotons) {}

  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    photons_.Preprocess(scene, context);
  }

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    if (!settings_.directWithPhotons) direct_.RequestSamples(scene, sampler, layout);
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
      return SurfaceLight{point.Le(), Direct(point, context), photons_.Caustic(point, context),
                          photons_.Indirect(point, context)}
          .Collect(point, context);
    });
  }

 private:
  Spectrum Direct(const ShadingPoint& point, LiContext& context) const {
    return settings_.directWithPhotons ? photons_.Direct(point, context)
                                       : direct_.AllLights(point, context);
  }

  Settings settings_;
  DirectLighting direct_;
  PhotonLighting photons_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<PhotonIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_PLUGIN("photonmap", "photon mapping with final gathering, the plain algorithm",
                exphoton::MakeForm<exphoton::PluginKind::Integrator>(exphoton::Parameters(),
                                                                     exphoton::Create))
