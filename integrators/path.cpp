// SPDX-License-Identifier: BSD-2-Clause
// The integrator "path" implements unidirectional path tracing with next event estimation. Tests
// use it as the reference for the photon integrators. At each vertex the power heuristic combines
// one light sample with the BSDF sample that continues the path (Veach 1997, chapters 9 and 10).
// With maxdepth d, light is collected at the first d + 1 surfaces of a path (0: emission and direct
// light only), as in pbrt-v1, which has the same default. Up to maxdepth the estimate is unbiased.
#include <algorithm>

#include "core/math/sampling/mis.h"
#include "core/plugin.h"
#include "core/transport/cut_light.h"
#include "core/transport/light_sample.h"
#include "core/transport/shading_point.h"
#include "core/transport/specular/specular_bounce.h"
#include "core/transport/volume_integrator.h"

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

// The uniform random numbers of one path vertex.
struct PathVertexVariates {
  Real lightChoice;
  Point2 light;
  Real lightPart;
  Point2 bsdf;
  Real bsdfLobe;
  Real roulette;
};

// The state of a path between two vertices.
struct PathState {
  RayDifferential ray;
  Spectrum beta{1};   // product of f |cos| / pdf so far
  Real etaScale = 1;  // product of 1/eta^2 at refractions; cancels the radiance scaling in beta
  SurfacePoint from;  // the last vertex
  Real bsdfPdf = 0;   // of the ray's direction, per solid angle at `from`
  bool isSpecular = true;  // camera ray or delta lobe: no light sample could find the emission
};

// PathHistory classifies the light that a path carries by the bounces so far, in order from the
// camera. It decides which light AOV a contribution is added to, and whether feature culling leaves
// it out. Indirect light has scattered at least twice at non-specular lobes. A caustic goes from
// the last non-specular scattering to the light over specular lobes only.
class PathHistory {
 public:
  PathHistory(const RequiredFeatures& features, AovSample* aovs)
      : hasIndirect_(features.Needs(Feature::Indirect)),
        hasCaustics_(features.Needs(Feature::Caustics)),
        aovs_(aovs) {}

  void Bounce(bool isSpecular) {
    isLastSpecular_ = isSpecular;
    if (bounces_++ == 0) isFirstSpecular_ = isSpecular;
    if (!isSpecular) ++scatterings_;
  }
  bool IsScattered() const { return scatterings_ > 0; }
  // Returns whether emission at the end of the path counts.
  bool TakesEmission() const { return scatterings_ == 0 || !isLastSpecular_ || hasCaustics_; }
  // Returns whether next event estimation at the path's end counts.
  bool TakesDirect() const { return scatterings_ == 0 || hasIndirect_; }
  // Returns the lobes that may continue the path.
  LobeSet Lobes(LobeSet all) const {
    return scatterings_ == 0 || hasIndirect_ ? all : all & LobeSet::Specular;
  }

  void AddEmission(const Spectrum& radiance) const {
    if (!aovs_) return;
    if (bounces_ == 0) {
      aovs_->emission += radiance;
    } else if (isFirstSpecular_) {
      aovs_->specular += radiance;
    } else if (bounces_ == 1) {
      aovs_->direct += radiance;
    } else if (scatterings_ == 1) {
      aovs_->caustic += radiance;
    } else {
      aovs_->indirect += radiance;
    }
  }
  // Adds the radiance of media along the path segment that begins at the last bounce.
  void AddMedia(const Spectrum& radiance) const {
    if (!aovs_) return;
    if (bounces_ == 0) {
      aovs_->emission += radiance;
    } else {
      (isFirstSpecular_ ? aovs_->specular : aovs_->indirect) += radiance;
    }
  }
  void AddDirect(const Spectrum& radiance) const {
    if (!aovs_) return;
    if (bounces_ == 0) {
      aovs_->direct += radiance;
    } else {
      (isFirstSpecular_ ? aovs_->specular : aovs_->indirect) += radiance;
    }
  }

 private:
  bool hasIndirect_, hasCaustics_;
  AovSample* aovs_;                    // null: no AOV is requested
  int bounces_ = 0, scatterings_ = 0;  // scatterings_: non-specular bounces only
  bool isFirstSpecular_ = false, isLastSpecular_ = false;
};

class PathIntegrator final : public SurfaceIntegrator {
 public:
  explicit PathIntegrator(const Settings& settings) : maxDepth_(settings.maxDepth) {}

  void Preprocess(const Scene& scene, PreprocessContext&) override {
    lights_ = scene.MakeLightSampler(LightSelection::Auto);
  }

  void RequestSamples(const Scene&, const Sampler&, SampleLayout* layout) override {
    for (VertexArrays& a : arrays_) {
      a = {layout->Request1D(1), layout->Request2D(1), layout->Request1D(1), layout->Request2D(1),
           layout->Request1D(1)};
    }
  }

  AovSet Aovs() const override { return kLightAovs; }

  FeatureSet ComputedFeatures() const override {
    return FeatureSet::All().Without(kPhotonMapFeatures);
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    PathState path;
    path.ray = ray;
    Spectrum sum;
    PathHistory history(context.scene.Features(), context.aovs);
    const LobeSet lobes = Lobes(context.scene);
    RandomStream random = context.Stream(kPathStream);
    for (int depth = 0;; ++depth) {
      const auto hit = context.Intersect(path.ray, KindOf(path, depth));
      const MediaSegment media = AlongMedia(path.ray, hit ? &hit->p : nullptr, context);
      const Spectrum added = path.beta * media.radiance;
      sum += added;
      history.AddMedia(added);
      path.beta *= media.transmittance;
      if (history.TakesEmission()) {
        const Spectrum emission = path.beta * Emission(path, hit ? &*hit : nullptr, context.scene);
        sum += emission;
        history.AddEmission(emission);
      }
      if (!hit) {
        if (depth == 0) context.alpha = sum.IsBlack() ? 0 : 1;
        break;
      }
      // The ray beyond the last vertex is traced only for the emission that it may hit.
      if (depth > maxDepth_) break;
      const Arena::Mark mark = context.arena.GetMark();
      const ShadingPoint point =
          MakeShadingPoint(*hit, path.ray, depth, TransportMode::Radiance, &context.arena);
      const PathVertexVariates sample = MakePathVertexVariates(depth, context, &random);
      if (history.TakesDirect()) {
        const Spectrum direct = path.beta * DirectLight(point, sample, context);
        sum += direct;
        history.AddDirect(direct);
      }
      if (depth == maxDepth_)
        MeasureCutLight({point, path.beta, history.IsScattered()}, *lights_, context);
      const bool goesOn = Continue(point, sample, history.Lobes(lobes), &path);
      history.Bounce(path.isSpecular);
      context.arena.Rewind(mark);
      if (!goesOn) break;
    }
    return sum;
  }

 private:
  static constexpr int kSampledVertices = 3;  // vertices that use the sampler, not a stream
  static constexpr int kRouletteDepth = 4;    // vertices before Russian roulette begins
  static constexpr Real kMaxSurvival = Real(.98);
  static constexpr std::uint64_t kPathStream = 0x9a7;

  struct VertexArrays {
    int choice1D = -1, light2D = -1, part1D = -1, bsdf2D = -1, lobe1D = -1;
  };

  static RayKind KindOf(const PathState& path, int depth) {
    if (depth == 0) return RayKind::Camera;
    return path.isSpecular ? RayKind::Specular : RayKind::Bsdf;
  }

  PathVertexVariates MakePathVertexVariates(int depth, const LiContext& context,
                                            RandomStream* random) const {
    RandomStream& r = *random;
    PathVertexVariates s;
    if (depth < kSampledVertices) {
      const VertexArrays& a = arrays_[std::size_t(depth)];
      const CameraSamples& samples = context.samples;
      s.lightChoice = samples.Array1D(a.choice1D)[0];
      s.light = samples.Array2D(a.light2D)[0];
      s.lightPart = samples.Array1D(a.part1D)[0];
      s.bsdf = samples.Array2D(a.bsdf2D)[0];
      s.bsdfLobe = samples.Array1D(a.lobe1D)[0];
    } else {
      s.lightChoice = r.Uniform();
      s.light = {r.Uniform(), r.Uniform()};
      s.lightPart = r.Uniform();
      s.bsdf = {r.Uniform(), r.Uniform()};
      s.bsdfLobe = r.Uniform();
    }
    s.roulette = r.Uniform();
    return s;
  }

  // Returns the emission at the ray's end, with the MIS weight against the light sample at the
  // vertex that the ray left.
  Spectrum Emission(const PathState& path, const SurfaceInteraction* hit,
                    const Scene& scene) const {
    const Vector3& w = path.ray.d;
    if (!hit) {
      if (path.isSpecular) return scene.EscapedRadiance(w);
      Spectrum sum;
      for (const Light* light : scene.InfiniteLights())
        sum += light->Le(w) * BsdfWeight(path, *light, nullptr);
      return sum;
    }
    if (!hit->areaLight) return {};
    const Spectrum radiance = hit->areaLight->L(*hit, hit->uv, hit->wo);
    if (path.isSpecular || radiance.IsBlack()) return radiance;
    return radiance * BsdfWeight(path, *hit->areaLight, hit);
  }
  Real BsdfWeight(const PathState& path, const Light& light, const SurfacePoint* on) const {
    const Real lightPdf =
        lights_->Pmf(path.from.p, light) * light.PdfDirect(path.from, path.ray.d, on);
    return PowerHeuristic(1, path.bsdfPdf, 1, lightPdf);
  }

  // f, Pdf and Sample must all use these lobes.
  static LobeSet Lobes(const Scene& scene) {
    return scene.Features().Needs(Feature::Specular) ? LobeSet::All : LobeSet::NonSpecular;
  }

  // Next event estimation with one light, chosen as LightSelection::Auto describes.
  Spectrum DirectLight(const ShadingPoint& point, const PathVertexVariates& sample,
                       LiContext& context) const {
    if (lights_->IsEmpty() || !point.bsdf.Has(LobeSet::NonSpecular)) return {};
    const auto choice = lights_->Sample(point.surface.p, sample.lightChoice);
    return FromLightSample(point,
                           {choice.light, choice.probability, sample.light, sample.lightPart}, {},
                           Lobes(context.scene), context);
  }

  // Extends the path by one BSDF sample. Returns false if the path ends.
  bool Continue(const ShadingPoint& point, const PathVertexVariates& sample, LobeSet lobes,
                PathState* path) const {
    const auto scattered = point.bsdf.Sample(point.Wo(), sample.bsdf, sample.bsdfLobe, lobes);
    if (!scattered) return false;
    // Beyond the last vertex, only emission that next event estimation also samples is collected.
    if (point.depth >= maxDepth_ && scattered->IsSpecular()) return false;
    path->beta *= scattered->throughput;
    if (scattered->IsSpecular() && scattered->IsTransmission()) {
      path->etaScale /= scattered->eta * scattered->eta;
    }
    if (!(path->beta.MaxComponent() > 0) || !path->beta.IsFinite()) return false;
    if (point.depth >= kRouletteDepth) {
      // etaScale removes the scaling of radiance by refraction, which does not affect how much
      // light the path will contribute.
      const Real survival = std::min(path->beta.MaxComponent() * path->etaScale, kMaxSurvival);
      if (!(sample.roulette < survival)) return false;
      path->beta /= survival;
    }
    path->ray = NextRay(point, *scattered);
    path->from = point.surface;
    path->bsdfPdf = scattered->pdf;
    path->isSpecular = scattered->IsSpecular();
    return true;
  }

  // Specular bounces keep the ray differentials of the pixel; other bounces have none.
  static RayDifferential NextRay(const ShadingPoint& point, const BsdfSample& scattered) {
    RayDifferential ray = SpawnRay(point.surface, scattered.wi);
    if (scattered.IsSpecular()) AddSpecularDifferentials(point, scattered, &ray);
    return ray;
  }

  int maxDepth_;
  std::unique_ptr<const LightSampler> lights_;
  std::array<VertexArrays, kSampledVertices> arrays_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<PathIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("path", "path tracing: all light transport, without bias")
