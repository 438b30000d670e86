// SPDX-License-Identifier: BSD-2-Clause
// The integrator "ambientocclusion" shows the share of the hemisphere over the first surface that
// is open: 1 where nothing is near, 0 in a closed corner. No light and no material plays a part;
// media neither attenuate nor scatter. Source: Zhukov, Iones and Kronin 1998, "An Ambient Light
// Illumination Model".
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

enum class Weighting { Uniform, Cosine };

struct Settings {
  int sampleCount = 2048;
  Real minDistance = 0;
  std::optional<Real> maxDistance;
  Weighting weighting = Weighting::Uniform;

  void Validate() const {
    if (maxDistance && !(*maxDistance > minDistance))
      throw ParamError{"maxdist", "must be above \"mindist\"", ""};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nsamples", &Settings::sampleCount, "rays at a point").Range(1, 65536),
      Param("mindist", &Settings::minDistance, "nearer surfaces do not occlude")
          .Range(0, 1e15)
          .Unit("scene units"),
      Param("maxdist", &Settings::maxDistance,
            "surfaces that are farther away do not occlude; no limit if absent")
          .Range(1e-15, 1e15)
          .Unit("scene units"),
      Param("weighting", &Settings::weighting,
            "all directions count alike, as in version 2, or by their cosine")
          .OneOf({{"uniform", Weighting::Uniform}, {"cosine", Weighting::Cosine}})};
  return table;
}

class AmbientOcclusionIntegrator final : public SurfaceIntegrator {
 public:
  explicit AmbientOcclusionIntegrator(const Settings& settings) : settings_(settings) {}

  void RequestSamples(const Scene&, const Sampler& sampler, SampleLayout* layout) override {
    directions2D_ = layout->Request2D(sampler.RoundCount(settings_.sampleCount));
  }

  std::vector<std::string> Explain(const Scene&) const override {
    return {"light         none: the open share of the hemisphere at the first surface"};
  }

  FeatureSet ComputedFeatures() const override {
    return {Feature::Lens, Feature::Motion, Feature::Environment};
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    const auto hit = context.Intersect(ray, RayKind::Camera);
    if (!hit) {
      const Spectrum sky = context.scene.EscapedRadiance(ray.d);
      context.alpha = sky.IsBlack() ? 0 : 1;
      return sky;
    }
    const Frame frame = Frame::FromZ(FaceForward(hit->ng, hit->wo));
    const RaySpawner spawner(*hit);
    const auto points = context.samples.Array2D(directions2D_);
    int open = 0;
    for (const Point2 u : points) {
      const Vector3 local = settings_.weighting == Weighting::Cosine ? SampleCosineHemisphere(u)
                                                                     : SampleUniformHemisphere(u);
      Ray probe = spawner.Spawn(frame.ToWorld(local));
      probe.o += probe.d * settings_.minDistance;
      if (settings_.maxDistance) probe.tMax = *settings_.maxDistance - settings_.minDistance;
      open += !context.Occluded(probe);
    }
    return Spectrum(Real(open) / Real(points.size()));
  }

 private:
  Settings settings_;
  int directions2D_ = -1;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<AmbientOcclusionIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("ambientocclusion", "the open share of the hemisphere over each point")
