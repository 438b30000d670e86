// SPDX-License-Identifier: BSD-2-Clause
// The integrator "path" implements unidirectional path tracing with next event estimation
// (core/transport/path/path_tracer.h). Tests use it as the reference for the photon integrators.
// With maxdepth d, light is collected at the first d + 1 surfaces of a path (0: emission and direct
// light only), as in pbrt-v1, which has the same default. Up to maxdepth the estimate is unbiased.
#include "core/plugin.h"
#include "core/transport/path/path_tracer.h"
#include "core/transport/path/unseen_light.h"

namespace exphoton {
namespace {

struct Settings {
  int maxDepth = 5;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxdepth", &Settings::maxDepth,
            "bounces after the first surface; 0: emission and direct light only")
          .Range(0, 10000)
          .WhenNamed(100)};
  return table;
}

class PathIntegrator final : public SurfaceIntegrator {
 public:
  explicit PathIntegrator(const Settings& settings) : paths_(settings.maxDepth) {}

  void Preprocess(const Scene& scene, PreprocessContext&) override { paths_.Preprocess(scene); }
  void RequestSamples(const Scene&, const Sampler&, SampleLayout* layout) override {
    paths_.RequestSamples<BsdfScattering>(layout);
  }
  AovSet Aovs() const override { return kLightAovs; }
  std::optional<int> EmissionDepth() const override { return 0; }
  std::vector<std::string> UnseenLight(const Scene& scene) const override {
    return UnseenByPaths(scene);
  }
  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kPhotonMapFeatures);
  }
  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    return paths_.Radiance(ray, BsdfScattering(), context);
  }

 private:
  PathTracer paths_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<PathIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("path", "path tracing: all light transport, without bias")
