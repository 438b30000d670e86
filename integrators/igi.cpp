// SPDX-License-Identifier: BSD-2-Clause
// The integrator "igi" implements instant global illumination: light paths leave virtual point
// lights on the surfaces, and every visible point takes its indirect light from one set of them
// (Keller 1997, "Instant Radiosity"; Wald et al. 2002). Direct light and specular recursion are as
// in "directlighting". Light that reaches a point over a specular surface (caustics) is missing.
// Near a virtual light the inverse square of the distance is bounded, which darkens corners. With
// "glimit" the geometric term is bounded instead, and gather rays add the missing part (Kollig and
// Keller 2004, "Illumination in the Presence of Weak Singularities").
#include <algorithm>

#include "core/lights/selection/light_selection.h"
#include "core/plugin.h"
#include "core/transport/direct_lighting.h"
#include "core/transport/light_sample.h"
#include "core/transport/specular/specular_tree.h"
#include "integrators/lightpaths/virtual_lights.h"

namespace exphoton {
namespace {

struct Settings {
  int lightPaths = 64, sets = 4;
  Real minDistance = Real(.1);
  Real rouletteThreshold = Real(.05);
  Real indirectScale = 1;
  int maxDepth = 5;
  int gatherSamples = 16;
  std::optional<Real> geometricLimit;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nlights", &Settings::lightPaths, "light paths of a set").Range(1, 1 << 20),
      Param("nsets", &Settings::sets, "sets of virtual lights; a camera sample uses one of them")
          .Range(1, 1 << 16),
      Param("mindist", &Settings::minDistance,
            "smaller distances to a virtual light count as this one; without \"glimit\"")
          .Range(0, 1e15)
          .Unit("scene units"),
      Param("rrthreshold", &Settings::rouletteThreshold,
            "contributions of a virtual light below this luminance are computed with probability "
            ".1 only; 0: all are computed")
          .Range(0, 1e6)
          .InVersion2({.0001}),
      Param("indirectscale", &Settings::indirectScale, "factor on indirect light").Range(0, 1e6),
      Param("maxdepth", &Settings::maxDepth,
            "specular bounces followed, and bounces of gather rays")
          .Range(0, 1000),
      Param("gathersamples", &Settings::gatherSamples,
            "with \"glimit\": gather rays for the light beyond the limit")
          .Range(1, 65536),
      Param("glimit", &Settings::geometricLimit,
            "bound of cos cos / distance^2 between a point and a virtual light; what is beyond it "
            "is gathered, so that corners keep their light; if absent, \"mindist\" bounds and the "
            "rest is lost")
          .Range(0, 1e15)
          .Unit("per square scene unit")
          .InVersion2({10})};
  return table;
}

constexpr std::uint64_t kRouletteStream = 0x696772, kGatherRayStream = 0x696767;
constexpr Real kSurvival = Real(.1);  // of contributions below the threshold

class IgiIntegrator final : public SurfaceIntegrator {
 public:
  explicit IgiIntegrator(const Settings& settings) : settings_(settings) {}

  void Preprocess(const Scene& scene, PreprocessContext& context) override {
    virtualLights_.Clear();
    lights_ = scene.MakeLightSampler(LightSelection::Auto);
    hasIndirect_ = scene.Features().Needs(Feature::Indirect) && settings_.indirectScale > 0;
    if (!hasIndirect_) return;
    const PhaseTimer timer(context.statistics, "virtual lights");
    virtualLights_.Trace(scene, settings_.sets, settings_.lightPaths, context);
    context.statistics.SetCounter("igi/virtual lights", double(virtualLights_.Count()),
                                  "in all sets together");
  }

  void RequestSamples(const Scene& scene, const Sampler& sampler, SampleLayout* layout) override {
    direct_.RequestSamples(scene, sampler, layout);
    set1D_ = layout->Request1D(1);
  }

  AovSet Aovs() const override { return kLightAovs; }

  std::optional<int> EmissionDepth() const override { return 0; }
  bool HasCostlySamples() const override { return true; }
  FeatureSet ComputedFeatures() const override {
    const FeatureSet some =
        FeatureSet::All().Without(kPhotonMapFeatures).Without({Feature::Caustics});
    return settings_.indirectScale > 0 ? some : some.Without({Feature::Indirect});
  }

  std::vector<std::string> Explain(const Scene& scene) const override {
    if (!scene.Features().Needs(Feature::Indirect))
      return {"light paths   none: no indirect light"};
    return {"light paths   " + std::to_string(settings_.sets) + " sets of " +
            std::to_string(settings_.lightPaths)};
  }

  Spectrum Li(const RayDifferential& ray, LiContext& context) const override {
    int set = 0;
    if (hasIndirect_) {
      const Real u = context.samples.Array1D(set1D_)[0];
      set = std::min(int(u * Real(settings_.sets)), settings_.sets - 1);
    }
    std::uint64_t shadings = 0;
    return SpecularTree(settings_.maxDepth, context, lights_.get())
        .Radiance(ray, [&](const ShadingPoint& point) {
          SurfaceLight light{point.Le(), direct_.AllLights(point, context), {}, {}};
          if (hasIndirect_) {
            const std::uint64_t shading = shadings++;
            light.indirect = settings_.indirectScale * Indirect(point, set, shading, context);
          }
          return light.Collect(point, context);
        });
  }

 private:
  // Returns the radiance that the point reflects from the virtual lights of a set.
  Spectrum Indirect(const ShadingPoint& point, int set, std::uint64_t shading,
                    LiContext& context) const {
    if (!point.bsdf.Has(LobeSet::NonSpecular)) return {};
    RandomStream random = context.Stream(HashKey({kRouletteStream, shading}));
    Spectrum sum;
    for (const LightPathVertex& light : virtualLights_.Set(set))
      sum += FromVirtualLight(point, light, &random, context);
    sum /= Real(settings_.lightPaths);
    if (!settings_.geometricLimit) return sum;
    RandomStream gather = context.Stream(HashKey({kGatherRayStream, shading}));
    Spectrum gathered;
    for (int i = 0; i < settings_.gatherSamples; ++i)
      gathered += Gathered(point, set, settings_.maxDepth, &gather, context);
    return sum + gathered / Real(settings_.gatherSamples);
  }

  // Returns the geometric term without the cosine at the receiving point.
  Real BoundedTerm(Real cosHere, Real cosThere, Real distance2) const {
    if (!settings_.geometricLimit) {
      const Real least = settings_.minDistance * settings_.minDistance;
      return SafeDivide(cosThere, std::max(distance2, least), Real(0));
    }
    const Real term = SafeDivide(cosThere, distance2, kInfinity);
    return SafeDivide(std::min(term * cosHere, *settings_.geometricLimit), cosHere, Real(0));
  }

  Spectrum FromVirtualLight(const ShadingPoint& point, const LightPathVertex& light,
                            RandomStream* random, LiContext& context) const {
    const Real uRoulette = random->Uniform();
    const SurfaceInteraction& there = light.point.surface;
    SurfacePoint place = there;
    if (there.motion) [[unlikely]]
      place = Carried(there, point.surface.time);
    const Vector3 between = place.p - point.surface.p;
    const Vector3 w = NormalizeOr(between, {});
    const Real distance2 = LengthSquared(between);
    if (w == Vector3{} || !(distance2 > 0)) return {};
    const Real cosHere = AbsDot(w, point.bsdf.Ns());
    const Spectrum f = point.bsdf.f(point.Wo(), w, LobeSet::NonSpecular) * cosHere;
    if (f.IsBlack()) return {};
    const Real term = BoundedTerm(cosHere, AbsDot(w, place.ng), distance2);
    Spectrum radiance = f * term * Scattered(light, -w, place.ng) * light.alpha;
    if (radiance.IsBlack() || !radiance.IsFinite()) return {};
    if (radiance.Y() < settings_.rouletteThreshold) {
      if (!(uRoulette < kSurvival)) return {};
      radiance /= kSurvival;
    }
    return radiance * context.Unoccluded(SpawnRayTo(point.surface, place));
  }

  // Returns the adjoint BSDF of a virtual light. Glossy lobes count as diffuse ones of the same
  // reflectance: their highlights would leave bright points.
  static Spectrum Scattered(const LightPathVertex& light, const Vector3& toPoint,
                            const Normal3& ng) {
    const Bsdf& bsdf = light.point.bsdf;
    const bool isMoved = light.point.surface.motion != nullptr;
    const bool isReflected = (Dot(toPoint, ng) > 0) == (Dot(light.point.Wo(), bsdf.Ng()) > 0);
    const LobeSet side = isReflected ? LobeSet::Reflection : LobeSet::Transmission;
    Spectrum f = bsdf.Rho(LobeSet::Glossy & side) * kInvPi;
    f += isMoved ? bsdf.Rho(LobeSet::Diffuse & side) * kInvPi
                 : AdjointBsdf(light.point, toPoint, LobeSet::Diffuse);
    return f;
  }

  // Returns a virtual light's place on a moving surface at another time.
  static SurfacePoint Carried(const SurfaceInteraction& surface, Real time) {
    const Transform then = surface.motion->At(surface.time), now = surface.motion->At(time);
    const Transform carry = now * then.Inverted();
    SurfacePoint place = surface;
    place.p = carry.ApplyPoint(surface.p);
    place.ng = NormalizeOr(carry.ApplyNormal(surface.ng), surface.ng);
    place.time = time;
    return place;
  }

  // Returns one estimate of the light beyond the limit of the geometric term: radiance that
  // surfaces near the point reflect towards it (Kollig and Keller 2004).
  Spectrum Gathered(const ShadingPoint& point, int set, int depth, RandomStream* random,
                    LiContext& context) const {
    if (depth == 0) return {};
    const Real x = random->Uniform(), y = random->Uniform();
    const auto sample =
        point.bsdf.Sample(point.Wo(), {x, y}, random->Uniform(), LobeSet::NonSpecular);
    if (!sample || sample->throughput.IsBlack()) return {};
    const RayDifferential ray = SpawnRay(point.surface, sample->wi);
    const auto hit = context.Intersect(ray, RayKind::Gather);
    if (!hit || !hit->material) return {};
    const Real cosHere = AbsDot(sample->wi, point.bsdf.Ns());
    const Real distance2 = DistanceSquared(point.surface.p, hit->p);
    const Real term = SafeDivide(cosHere * AbsDot(sample->wi, hit->ng), distance2, kInfinity);
    if (!(term > *settings_.geometricLimit)) return {};
    const Real share = 1 - *settings_.geometricLimit / term;
    const Arena::Mark mark = context.arena.GetMark();
    const ShadingPoint there =
        MakeShadingPoint(*hit, ray, point.depth, TransportMode::Radiance, &context.arena);
    Ray stretch = ray;
    stretch.tMax = Distance(ray.o, hit->p);
    const Spectrum radiance =
        context.scene.Transmittance(stretch) * Reflected(there, set, depth - 1, random, context);
    context.arena.Rewind(mark);
    return sample->throughput * share * radiance;
  }

  // Returns the radiance that the non-specular lobes of a gather ray's hit reflect.
  Spectrum Reflected(const ShadingPoint& point, int set, int depth, RandomStream* random,
                     LiContext& context) const {
    if (!point.bsdf.Has(LobeSet::NonSpecular)) return {};
    Spectrum sum;
    if (!lights_->IsEmpty()) {
      const auto choice = lights_->Sample(point.Receiver(), random->Uniform());
      const Real x = random->Uniform(), y = random->Uniform();
      const SampledLight sampled{choice.light, choice.probability, {x, y}, random->Uniform()};
      sum += FromLightSample(point, sampled, {1, 0}, LobeSet::NonSpecular, context);
    }
    Spectrum indirect;
    for (const LightPathVertex& light : virtualLights_.Set(set))
      indirect += FromVirtualLight(point, light, random, context);
    sum += indirect / Real(settings_.lightPaths);
    return sum + Gathered(point, set, depth, random, context);
  }

  Settings settings_;
  bool hasIndirect_ = false;
  int set1D_ = -1;
  DirectLighting direct_;
  std::unique_ptr<const LightSampler> lights_;
  VirtualLights virtualLights_;
};

std::unique_ptr<SurfaceIntegrator> Create(const Settings& settings, const IntegratorContext&) {
  return std::make_unique<IgiIntegrator>(settings);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_INTEGRATOR("igi", "instant global illumination: indirect light from virtual point lights")
