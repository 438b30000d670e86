// SPDX-License-Identifier: BSD-2-Clause
// Integrator "openness": the share of the hemisphere over a point that is open, weighted by the
// cosine; also called ambient occlusion. No light and no material plays a part.
// Source: Zhukov, Iones and Kronin 1998, "An Ambient Light Illumination Model".
#include "core/math/sampling/sampling.h"
#include "core/plugin.h"

namespace exphoton {
namespace {

struct Settings {
  int sampleCount = 16;
  std::optional<Real> reach;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nsamples", &Settings::sampleCount, "rays at a point").Range(1, 65536),
      Param("reach", &Settings::reach, "what is farther away does not occlude; no limit if absent")
          .Above(0)
          .Unit("scene units")};
  return table;
}

class OpennessIntegrator final : public SurfaceIntegrator {
 public:
  explicit OpennessIntegrator(const Settings& settings) : settings_(settings) {}

  void RequestSamples(const Scene&, const Sampler& sampler, SampleLayout* layout) override {
    directions_ = layout->Request2D(sampler.RoundCount(settings_.sampleCount));
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    const auto hit = context.Intersect(ray, RayKind::Camera);
    if (!hit) {
      context.alpha = 0;
      return {};
    }
    const Frame frame = Frame::FromZ(FaceForward(hit->ng, hit->wo));
    const auto points = context.samples.Array2D(directions_);
    int open = 0;
    for (const Point2 u : points) {
      // Directions with density cos / pi per solid angle: each counts alike.
      Ray probe = SpawnRay(*hit, frame.ToWorld(SampleCosineHemisphere(u)));
      if (settings_.reach) probe.tMax = *settings_.reach;
      open += !context.Occluded(probe);
    }
    return Spectrum(Real(open) / Real(points.size()));
  }

 private:
  Settings settings_;
  int directions_ = 0;  // handle of the sample array
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<OpennessIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("openness", "the open share of the hemisphere over each point")
