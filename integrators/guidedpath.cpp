// SPDX-License-Identifier: BSD-2-Clause
// guidedpath: path tracing guided by photons. Preprocess shoots photons only to learn where light
// comes from. At each vertex, one direction is sampled from the BSDF, one from the directions of
// nearby photons, and one light (docs/theory/other-integrators.md). No photon adds radiance,
// so the estimate is unbiased for every path that `path` can find.
#include "core/base/memory.h"
#include "core/plugin.h"
#include "core/transport/path/path_tracer.h"
#include "core/transport/path/unseen_light.h"
#include "integrators/photon/gather/path_guide.h"
#include "integrators/photon/photon_budget.h"
#include "integrators/photon/photon_pass.h"

namespace exphoton {
namespace {

struct Settings : PhotonSettings {
  Settings() {
    maxDepth = 5;
    photonRoulette = PhotonRoulette::Luminance;
    lightSelection = LightSelection::Power;
    photonTargeting = PhotonTargeting::Auto;
    guideEmission = true;
    gatherPhotons = 128;
    gatherAngle = 6;
  }
};

const ParamTable<Settings>& Parameters() {
  using S = PhotonSettings;
  static const ParamTable<S> base{
      Param("maxdepth", &S::maxDepth,
            "bounces after the first surface; 0: emission and direct light only")
          .Basic()
          .Range(0, 10000)
          .WhenNamed(100),
      Param("indirectphotons", &S::indirectPhotons, "photons wanted for guiding; 0: no guiding")
          .Basic()
          .Range(0, 1e9)
          .DividedByQuick(10),
      Param("gatherphotons", &S::gatherPhotons, "photons whose directions guide a path at a vertex")
          .Range(1, 10000),
      Param("gatherangle", &S::gatherAngle, "half-angle of the cone round a photon's direction")
          .Above(0)
          .AtMost(90)
          .Unit("degrees"),
      Param("maxphotonpaths", &S::maxPhotonPaths, "paths after which no more photons are shot")
          .Range(1, 1e15),
      Param("guideemission", &S::guideEmission,
            "photons start where earlier ones reached an indirect surface, if few do")};
  static const ParamTable<Settings> table{base};
  return table;
}

class GuidedPathIntegrator final : public SurfaceIntegrator {
 public:
  explicit GuidedPathIntegrator(const Settings& settings)
      : settings_(settings),
        paths_(settings.maxDepth),
        guide_(settings.gatherPhotons, Cone(Radians(settings.gatherAngle))) {}

  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    guide_.Clear();
    map_ = {};
    paths_.Preprocess(scene);
    const PhotonTargets targets = Targets(scene);
    if (targets.Least() == 0) return;
    if (BytesOf(targets) > PhysicalMemory()) FailByMemory(targets);
    PhotonPassResult photons = ShootPhotons(scene, settings_, targets, context);
    const PhaseTimer timer(context.statistics, "photon maps");
    map_ = PhotonMap(std::move(photons[PhotonKind::Indirect]), context.threads);
    if (!map_.IsEmpty()) guide_.Prepare(map_);
  }

  void RequestSamples(const Scene&, const Sampler&, SampleLayout* layout) override {
    paths_.RequestSamples<PathGuide>(layout);
  }
  AovSet Aovs() const override { return kLightAovs; }
  std::optional<int> EmissionDepth() const override { return 0; }
  std::vector<std::string> UnseenLight(const Scene& scene) const override {
    return UnseenByPaths(scene);
  }
  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kPhotonMapFeatures);
  }
  std::vector<std::string> Explain(const Scene& scene) const override;

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    return paths_.Radiance(ray, guide_, context);
  }

 private:
  // Guides help only with indirect light: next event estimation finds the rest.
  PhotonTargets Targets(const Scene& scene) const {
    PhotonTargets targets;
    if (scene.Features().Needs(Feature::Indirect) && settings_.maxDepth > 0)
      targets[PhotonKind::Indirect] = settings_.indirectPhotons;
    return targets;
  }

  Settings settings_;
  PathTracer paths_;
  PhotonMap map_;
  PathGuide guide_;
};

std::vector<std::string> GuidedPathIntegrator::Explain(const Scene& scene) const {
  const PhotonTargets targets = Targets(scene);
  if (targets.Least() > 0) {
    return {"photons       " + TextOf(targets) + ", for guiding alone",
            "guide         " + std::to_string(settings_.gatherPhotons) + " photons at a vertex"};
  }
  const char* reason = settings_.indirectPhotons == 0 ? "indirectphotons is 0"
                       : settings_.maxDepth == 0      ? "maxdepth is 0"
                                                      : "no indirect light";
  return {"photons       none", std::string("guide         off (") + reason + ")"};
}

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<GuidedPathIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("guidedpath", "path tracing guided by photons, without bias")
