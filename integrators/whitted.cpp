// SPDX-License-Identifier: BSD-2-Clause
// The integrator "whitted" computes emission, direct light by one shadow ray per light, and
// specular recursion. Area lights and infinite lights are sampled at one random point, without BSDF
// samples. The estimate is unbiased, but noisier than "directlighting" for large lights and glossy
// surfaces. Source: Whitted 1980, "An Improved Illumination Model for Shaded Display".
#include "core/plugin.h"
#include "core/transport/shading_point.h"
#include "core/transport/specular/specular_tree.h"

namespace exphoton {
namespace {

struct Settings {
  int maxDepth = 5;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxdepth", &Settings::maxDepth, "specular bounces followed").Range(0, 1000)};
  return table;
}

class WhittedIntegrator final : public SurfaceIntegrator {
 public:
  explicit WhittedIntegrator(const Settings& settings) : maxDepth_(settings.maxDepth) {}

  void Preprocess(const Scene& scene, PreprocessContext&) override {
    lights_ = MakeCutLightSampler(scene);
  }
  void RequestSamples(const Scene& scene, const Sampler&, SampleLayout* layout) override {
    arrays_.assign(scene.Lights().size(), {});
    for (std::size_t i = 0; i < arrays_.size(); ++i) {
      const Light& light = *scene.Lights()[i];
      if (light.IsProvablyBlack() || light.IsDelta()) continue;
      arrays_[i] = {layout->Request2D(1), layout->Request1D(1)};
    }
  }

  AovSet Aovs() const override { return kLightAovs; }

  std::optional<int> EmissionDepth() const override { return 0; }
  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kInterreflection).Without(kPhotonMapFeatures);
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    return SpecularTree(maxDepth_, context, lights_.get())
        .Radiance(ray, [&](const ShadingPoint& point) {
          return SurfaceLight{point.Le(), DirectLight(point, context), {}, {}}.Collect(point,
                                                                                       context);
        });
  }

 private:
  struct LightArrays {
    int light2D = -1, part1D = -1;
  };

  Spectrum DirectLight(const ShadingPoint& point, LiContext& context) const {
    Spectrum sum;
    if (!point.bsdf.Has(LobeSet::NonSpecular)) return sum;
    for (std::size_t i = 0; i < arrays_.size(); ++i) {
      const Light& light = *context.scene.Lights()[i];
      if (light.IsProvablyBlack()) continue;
      Point2 u;
      Real uSubLight = 0;
      if (arrays_[i].light2D >= 0) {
        u = context.samples.Array2D(arrays_[i].light2D)[0];
        uSubLight = context.samples.Array1D(arrays_[i].part1D)[0];
      }
      sum += OneLight(point, light, u, uSubLight, context);
    }
    return sum;
  }

  static Spectrum OneLight(const ShadingPoint& point, const Light& light, Point2 u, Real uSubLight,
                           LiContext& context) {
    const auto direct = light.SampleDirect(point.surface, u, uSubLight);
    if (!direct || direct->Li.IsBlack()) return {};
    const Spectrum f = point.bsdf.f(point.Wo(), direct->wi, LobeSet::NonSpecular);
    if (f.IsBlack()) return {};
    return f * context.Unoccluded(direct->shadowRay) * direct->Li *
           (AbsDot(direct->wi, point.bsdf.Ns()) / direct->pdf);
  }

  int maxDepth_;
  std::unique_ptr<const LightSampler> lights_;  // for cut light only
  std::vector<LightArrays> arrays_;  // one per light; handles are -1 for black and delta lights
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<WhittedIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("whitted", "direct light from one point of each light, and specular recursion")
