// SPDX-License-Identifier: BSD-2-Clause
// The integrator "directlighting" computes emission, direct light (light and BSDF samples combined
// by the power heuristic) and specular recursion, but no interreflection. The strategies have the
// same mean: "all" samples every light; "one" picks one light per camera sample, uniformly;
// "weighted" picks it in proportion to power; "near" picks one per point, by power and distance.
#include "core/plugin.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/specular/specular_tree.h"

namespace exphoton {
namespace {

enum class Strategy { All, One, Weighted, Near };

struct Settings {
  int maxDepth = 5;
  Strategy strategy = Strategy::All;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("maxdepth", &Settings::maxDepth, "specular bounces followed").Range(0, 1000),
      Param("strategy", &Settings::strategy,
            "sample all lights, one at random, one at random by power, or by power and distance")
          .OneOf({{"all", Strategy::All},
                  {"one", Strategy::One},
                  {"weighted", Strategy::Weighted},
                  {"near", Strategy::Near}})};
  return table;
}

class DirectLightingIntegrator final : public SurfaceIntegrator {
 public:
  explicit DirectLightingIntegrator(const Settings& settings) : settings_(settings) {
    if (settings.strategy == Strategy::Near) direct_ = DirectLighting(1, 1);
  }

  void Preprocess(const Scene& scene, PreprocessContext&) override {
    cutLights_ = MakeCutLightSampler(scene);
    if (!ChoosesForSample()) return;
    const bool byPower = settings_.strategy == Strategy::Weighted;
    lights_ = scene.MakeLightSampler(byPower ? LightSelection::Power : LightSelection::Uniform);
  }
  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    if (!ChoosesForSample()) {
      direct_.RequestSamples(scene, sampler, layout);
    } else {
      arrays_ = {layout->Request1D(1), layout->Request2D(1), layout->Request1D(1),
                 layout->Request2D(1), layout->Request1D(1)};
    }
  }

  AovSet Aovs() const override { return kLightAovs; }

  std::optional<int> EmissionDepth() const override { return 0; }
  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kInterreflection).Without(kPhotonMapFeatures);
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    return SpecularTree(settings_.maxDepth, context, cutLights_.get())
        .Radiance(ray, [&](const ShadingPoint& point) {
          return SurfaceLight{point.Le(), DirectLight(point, context), {}, {}}.Collect(point,
                                                                                       context);
        });
  }

 private:
  struct OneLightArrays {
    int choice1D = -1, light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
  };

  // Returns whether one light is chosen per camera sample, for all points of its specular tree.
  bool ChoosesForSample() const {
    return settings_.strategy == Strategy::One || settings_.strategy == Strategy::Weighted;
  }

  Spectrum DirectLight(const ShadingPoint& point, LiContext& context) const {
    if (!ChoosesForSample()) return direct_.AllLights(point, context);
    if (lights_->IsEmpty()) return {};
    const CameraSamples& samples = context.samples;
    const auto choice = lights_->Sample(point.Receiver(), samples.Array1D(arrays_.choice1D)[0]);
    const DirectLightingVariates sample{
        samples.Array2D(arrays_.light2D)[0], samples.Array1D(arrays_.part1D)[0],
        samples.Array2D(arrays_.bsdf2D)[0], samples.Array1D(arrays_.lobe1D)[0]};
    return EstimateDirect(point, *choice.light, sample, context) / choice.probability;
  }

  Settings settings_;
  DirectLighting direct_;
  std::unique_ptr<const LightSampler> lights_;     // null unless ChoosesForSample()
  std::unique_ptr<const LightSampler> cutLights_;  // for cut light only
  OneLightArrays arrays_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<DirectLightingIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("directlighting", "direct light and specular recursion")
