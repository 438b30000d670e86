// SPDX-License-Identifier: BSD-2-Clause
// The volume integrator "emission" computes the emission of media, but no scattering.
#include "integrators/volumeintegrators/common/march.h"

namespace exphoton {
namespace {

class EmissionIntegrator final : public VolumeIntegrator {
 public:
  explicit EmissionIntegrator(const MarchSettings& settings) : stepSize_(settings.stepSize) {}

  Spectrum Li(const Ray& ray, LiContext& context, RandomStream random) const override {
    const Scene& scene = context.scene;
    return March(ray, scene, stepSize_, random.Uniform(), [&](const Point3& p) {
      Spectrum emission;
      for (const auto& medium : scene.Media()) emission += medium->At(p).emission;
      return emission;
    });
  }

 private:
  Real stepSize_;
};

const ParamTable<MarchSettings>& Parameters() { return MarchParameters(); }

std::unique_ptr<VolumeIntegrator> Create(const MarchSettings& settings, const NoContext&) {
  return std::make_unique<EmissionIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_VOLUME_INTEGRATOR("emission", "media emit and absorb")
