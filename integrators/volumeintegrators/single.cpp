// SPDX-License-Identifier: BSD-2-Clause
// The volume integrator "single" computes emission of media and single scattering of direct light.
// At each step it chooses one light and samples one point on it: by power (half of the choices are
// uniform), or from 16 lights on by a tree of power and distance.
#include "integrators/volumeintegrators/common/march.h"

namespace exphoton {
namespace {

class SingleScattering final : public VolumeIntegrator {
 public:
  explicit SingleScattering(const MarchSettings& settings) : stepSize_(settings.stepSize) {}

  bool ScattersLight() const override { return true; }

  void Preprocess(const Scene& scene) override {
    lights_ = scene.MakeLightSampler(LightSelection::Auto);
  }

  Spectrum Li(const Ray& ray, LiContext& context, RandomStream random) const override {
    const Scene& scene = context.scene;
    const Real offset = random.Uniform();
    return March(ray, scene, stepSize_, offset, [&](const Point3& p) {
      Spectrum source;
      for (const auto& medium : scene.Media()) source += medium->At(p).emission;
      return source + Scattered(p, ray, context, &random);
    });
  }

 private:
  // Returns sigma_s * phase, summed over the media, times the light of one sampled light.
  Spectrum Scattered(const Point3& p, const Ray& ray, LiContext& context,
                     RandomStream* random) const {
    // Draw all numbers even if they are not needed, so that later steps always get the same ones.
    const Real uLight = random->Uniform(), uSubLight = random->Uniform(), u = random->Uniform();
    const Point2 uPoint{u, random->Uniform()};
    if (lights_->IsEmpty()) return {};
    const auto choice = lights_->Sample(p, uLight);
    const SurfacePoint at{p, Abs(p) * Gamma(3), Normal3(), ray.time};
    const auto direct = choice.light->SampleDirect(at, uPoint, uSubLight);
    if (!direct || direct->Li.IsBlack()) return {};
    Spectrum scattering;
    for (const auto& medium : context.scene.Media())
      scattering += medium->At(p).scattering * medium->Phase(-ray.d, direct->wi);
    if (scattering.IsBlack()) return {};
    const Spectrum arriving = context.Unoccluded(direct->shadowRay);
    return scattering * arriving * direct->Li / (direct->pdf * choice.probability);
  }

  Real stepSize_;
  std::unique_ptr<const LightSampler> lights_;
};

const ParamTable<MarchSettings>& Parameters() { return MarchParameters(); }

std::unique_ptr<VolumeIntegrator> Create(const MarchSettings& settings, const NoContext&) {
  return std::make_unique<SingleScattering>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_VOLUME_INTEGRATOR("single", "media emit, absorb and scatter light once")
