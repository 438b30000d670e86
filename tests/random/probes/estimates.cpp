// SPDX-License-Identifier: BSD-2-Clause
// CompareEstimates computes each estimate in batches, whose scatter gives the standard error.
#include "tests/random/probes/estimates.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/math/sampling/sampling.h"
#include "core/transport/volume_integrator.h"
#include "tests/random/probes/focused_scene.h"
#include "tests/random/probes/probed_scene.h"
#include "tests/random/scenes/statistics.h"

namespace exphoton::random_scenes {
namespace {

constexpr int kBatches = 16;
constexpr Real kLargestBall = Real(.8), kSmallestBall = Real(.2);  // radii
constexpr double kSmall = 1e-4;  // estimates below this are not compared
constexpr double kDim = .05;     // the same for light, whose rare samples have much weight

using Estimate = std::function<double(RandomStream*)>;

// EstimateComparison makes pairs of estimates and compares them.
class EstimateComparison {
 public:
  EstimateComparison(std::uint64_t seed, int factor) : seed_(seed), factor_(factor) {}

  struct Side {
    int samples;  // of a batch
    Estimate estimate;
  };
  // Compares the means of two estimates.
  void Add(const std::string& what, double margin, const Side& a, const Side& b,
           double least = kSmall) {
    const Sample left = Means(a.samples, a.estimate), right = Means(b.samples, b.estimate);
    const double scale = std::max(std::abs(left.mean), std::abs(right.mean));
    if (!(scale > least)) return;
    // Surfaces at one place may hide each other by turns. No such scene was examined yet.
    if (what.starts_with("density") && (left.mean == 0 || right.mean == 0)) return;
    char detail[120];
    std::snprintf(detail, sizeof detail, "%.5g +- %.2g against %.5g +- %.2g", left.mean,
                  std::sqrt(left.variance), right.mean, std::sqrt(right.variance));
    comparisons_.push_back({what + ", pair " + std::to_string(purpose_ / 2),
                            PValueBeyond(left, right, margin * scale), left.mean - right.mean,
                            detail});
  }

  std::vector<Comparison> Take() { return std::move(comparisons_); }

 private:
  Sample Means(int count, const Estimate& estimate) {
    RandomStream random(HashKey({seed_, purpose_++}));
    std::vector<double> means;
    for (int k = 0; k < kBatches; ++k) {
      double sum = 0;
      for (int i = 0; i < count * factor_; ++i) sum += estimate(&random);
      means.push_back(sum / (count * factor_));
    }
    return SampleOf(means);
  }

  std::uint64_t seed_;
  int factor_;
  std::uint64_t purpose_ = 0;
  std::vector<Comparison> comparisons_;
};

Real RandomTime(const ProbedScene& scene, RandomStream* random) {
  const Interval times = scene.World().Exposure();
  return Lerp(random->Uniform(), times.min, times.max);
}

struct Ball {
  Point3 centre;
  Real radius;
};

// Returns the length of a ray of unit direction inside the ball, in 0 < t < tMax.
double LengthInBall(const Ray& ray, const Ball& ball) {
  const Vector3 to = ball.centre - ray.o;
  const double middle = double(Dot(to, ray.d)), radius = double(ball.radius);
  const double half2 = radius * radius - double(LengthSquared(to)) + middle * middle;
  if (!(half2 > 0)) return 0;
  const double half = std::sqrt(half2);
  return std::max(0., std::min(middle + half, double(ray.tMax)) - std::max(middle - half, 0.));
}

Point3 PointInBall(const Ball& ball, RandomStream* random) {
  const Real r = ball.radius * std::cbrt(random->Uniform());
  return ball.centre + SampleUniformSphere(NextPoint(random)) * r;
}

// Returns a ball about the point that keeps clear of the light: near a lamp, the light by samples
// of direct light has infinite variance. Returns nullopt if the light is too close.
std::optional<Ball> BallClearOf(const Light& light, const Point3& centre) {
  const auto bounds = light.Bounds();
  if (!bounds) return Ball{centre, kLargestBall};
  const Point3 nearest = Max(bounds->min, Min(bounds->max, centre));
  const Real radius = std::min(kLargestBall, Real(.7) * Distance(nearest, centre));
  return radius < kSmallestBall ? std::nullopt : std::optional(Ball{centre, radius});
}

double LightByEmission(const ProbedScene& scene, const Light& light, const Ball& ball,
                       RandomStream* random) {
  const Point2 u = NextPoint(random), v = NextPoint(random);
  const Real part = random->Uniform();
  const auto sample = light.SampleEmission(u, v, part, RandomTime(scene, random));
  if (!sample) return 0;
  Ray ray = sample->ray;
  if (!(LengthInBall(ray, ball) > 0)) return 0;
  const auto hit = scene.World().IntersectPoint(ray);
  if (hit) ray.tMax = hit->hit.t;
  const double volume = 4. / 3 * double(kPi) * std::pow(double(ball.radius), 3);
  return double(sample->power.Y()) * LengthInBall(ray, ball) / volume;
}

double LightByDirect(const ProbedScene& scene, const Light& light, const Ball& ball,
                     RandomStream* random) {
  const SurfacePoint point{PointInBall(ball, random), {}, {}, RandomTime(scene, random)};
  const Point2 u = NextPoint(random);
  const auto direct = light.SampleDirect(point, u, random->Uniform());
  if (!direct || scene.World().Occluded(direct->shadowRay)) return 0;
  return double(direct->Li.Y()) / double(direct->pdf);
}

// The power of a moving lamp that is stretched unevenly is by Simpson's rule over three times.
bool HasStretchedMovingLamp(const SceneModel& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const BodyModel& body) {
    return body.emission != 0 && body.motion != 0 && body.stretch == 1;
  });
}

void CompareInBall(const ProbedScene& scene, const Light& light, const Ball& ball,
                   EstimateComparison* comparison) {
  comparison->Add("light in a ball", .03,
                  {192, [&](RandomStream* r) { return LightByEmission(scene, light, ball, r); }},
                  {64, [&](RandomStream* r) { return LightByDirect(scene, light, ball, r); }},
                  kDim);
}

// Returns the radiance that a random line meets on the light, at all places where it crosses its
// surface from the front, times a factor. A line in a random direction through a random point of a
// disk of radius R crosses a piece dA from the front dA / (4 pi R^2) times (Cauchy and Crofton), so
// the mean is the power, which is pi times the integral of the radiance over the surface.
double PowerByLine(const ProbedScene& scene, const Light& light, const Bounds3& bounds,
                   RandomStream* random) {
  constexpr int kMostHits = 64;
  const Point3 centre = bounds.min * Real(.5) + bounds.max * Real(.5);
  const Real radius = Distance(bounds.max, bounds.min) * Real(.505);
  const Frame frame = Frame::FromZ(SampleUniformSphere(NextPoint(random)));
  const Point2 u = NextPoint(random);
  const Real r = radius * std::sqrt(u.x), phi = 2 * kPi * u.y;
  Ray ray;
  ray.o = centre + frame.x * (r * std::cos(phi)) + frame.y * (r * std::sin(phi)) - frame.z * radius;
  ray.d = frame.z, ray.tMax = kInfinity, ray.time = RandomTime(scene, random);
  double sum = 0;
  for (int i = 0; i < kMostHits; ++i) {
    const auto sight = scene.Look(ray);
    if (!sight) break;
    const SurfaceInteraction& s = sight->surface;
    if (s.areaLight == &light) sum += double(s.areaLight->L(s, s.uv, s.wo).Y());
    ray = SpawnRay(s, ray.d);
  }
  return sum * 4 * double(kPi) * double(kPi) * double(radius) * double(radius);
}

void CompareLight(const ProbedScene& scene, const Light& light, bool comparesPower,
                  RandomStream* random, EstimateComparison* comparison) {
  const Real half = Real(.7);
  const Point3 centre(half * (2 * random->Uniform() - 1), half * (2 * random->Uniform() - 1),
                      half * (2 * random->Uniform() - 1));
  // Rays of far lights cover the world only.
  const Bounds3& world = scene.World().WorldBounds();
  const Vector3 half3(kLargestBall, kLargestBall, kLargestBall);
  const bool isFar = light.IsDistant() || light.IsInfinite();
  const Bounds3 about(centre - half3, centre + half3);
  const auto ball = BallClearOf(light, centre);
  if (ball && (!isFar ||
               (Min(world.min, about.min) == world.min && Max(world.max, about.max) == world.max)))
    CompareInBall(scene, light, *ball, comparison);
  if (!comparesPower) return;
  const double power = double(light.Power().Y());
  comparison->Add("power", .05,
                  {96,
                   [&](RandomStream* r) {
                     const Point2 u = NextPoint(r), v = NextPoint(r);
                     const Real part = r->Uniform();
                     const auto sample = light.SampleEmission(u, v, part, RandomTime(scene, r));
                     return sample ? double(sample->power.Y()) : 0;
                   }},
                  {1, [&](RandomStream*) { return power; }});
}

// Compares the power of a lamp that is alone with the light that lines meet on it.
void CompareLoneLamp(std::uint64_t seed, EstimateComparison* comparison) {
  SceneModel model = LoneLamp(HashKey({seed, 32}));
  model.bodies.front().motion = 0;  // so that its bounds are tight, and more lines meet it
  const ProbedScene scene(SceneText(model, {}), seed, 0);
  for (const auto& light : scene.World().Lights()) {
    const auto bounds = light->Bounds();
    if (!bounds) continue;
    const double power = double(light->Power().Y());
    comparison->Add("power by lines", .05,
                    {192, [&](RandomStream* r) { return PowerByLine(scene, *light, *bounds, r); }},
                    {1, [&](RandomStream*) { return power; }}, kDim);
  }
}

// Directions draws from half a uniform cone and half a sampler, and gives the ratio of the
// sampler's density and this mixture's density. Its mean is the share of samples that succeed.
struct ConeAround {
  Frame frame;
  Real oneMinusCos = 2;

  Vector3 Sample(Point2 u) const { return frame.ToWorld(SampleUniformCone(u, oneMinusCos)); }
  double Pdf(const Vector3& w) const {
    return 1 - Dot(w, frame.z) <= oneMinusCos ? double(UniformConePdf(oneMinusCos)) : 0;
  }
};

ConeAround ConeOf(const Light& light, const Point3& p) {
  ConeAround cone{Frame::FromZ(Vector3(0, 0, 1)), 2};
  const auto bounds = light.Bounds();
  if (!bounds) return cone;
  const Point3 centre = bounds->min * Real(.5) + bounds->max * Real(.5);
  const Real radius = Distance(bounds->max, bounds->min) * Real(.505), d = Distance(p, centre);
  if (!(d > radius) || radius == 0) return cone;
  cone.frame = Frame::FromZ((centre - p) / d);
  cone.oneMinusCos = 1 - SafeSqrt(1 - radius * radius / (d * d));
  return cone;
}

// Returns the density of the light's samples in a direction if the light is seen there, or 0.
double VisibleDensity(const ProbedScene& scene, const Light& light, const SurfacePoint& from,
                      const Vector3& w) {
  const Ray ray = SpawnRay(from, w);
  const auto sight = scene.Look(ray);
  if (light.IsInfinite()) return sight ? 0 : double(light.PdfDirect(from, w, nullptr));
  if (!sight || sight->surface.areaLight != &light) return 0;
  if (!(Dot(sight->surface.ng, w) < 0)) return 0;
  return double(light.PdfDirect(from, w, &sight->surface));
}

void CompareLightDensity(const ProbedScene& scene, const Light& light, const SurfacePoint& from,
                         EstimateComparison* comparison) {
  const ConeAround cone = ConeOf(light, from.p);
  const auto draw = [&scene, &light, from](RandomStream* r) -> std::optional<Vector3> {
    const Point2 u = NextPoint(r);
    const auto direct = light.SampleDirect(from, u, r->Uniform());
    if (!direct || scene.World().Occluded(direct->shadowRay)) return std::nullopt;
    return direct->wi;
  };
  comparison->Add("density of a light", .02,
                  {64,
                   [&](RandomStream* r) {
                     const bool isUniform = r->Uniform() < Real(.5);
                     const Point2 u = NextPoint(r);
                     const auto w = isUniform ? std::optional<Vector3>(cone.Sample(u)) : draw(r);
                     if (!w) return 0.;
                     const double pdf = VisibleDensity(scene, light, from, *w);
                     return pdf == 0 ? 0. : pdf / (.5 * cone.Pdf(*w) + .5 * pdf);
                   }},
                  {48, [&](RandomStream* r) { return draw(r) ? 1. : 0.; }});
}

void CompareBsdfDensity(const Sight& sight, Arena* arena, EstimateComparison* comparison) {
  SurfaceInteraction surface = sight.surface;
  const Bsdf bsdf = surface.material->Evaluate(&surface, TransportMode::Radiance, arena);
  const LobeSet mask = LobeSet::NonSpecular;
  if (!bsdf.Has(mask)) return;
  const Vector3 wo = surface.wo;
  const auto draw = [&](RandomStream* r) {
    const Point2 u = NextPoint(r);
    return bsdf.Sample(wo, u, r->Uniform(), mask);
  };
  comparison->Add("density of a BSDF", .02,
                  {64,
                   [&](RandomStream* r) {
                     const bool isUniform = r->Uniform() < Real(.5);
                     Vector3 w = SampleUniformSphere(NextPoint(r));
                     if (!isUniform) {
                       const auto sample = draw(r);
                       if (!sample) return 0.;
                       w = sample->wi;
                     }
                     const double pdf = double(bsdf.Pdf(wo, w, mask));
                     return pdf / (.5 * double(kUniformSpherePdf) + .5 * pdf);
                   }},
                  {48, [&](RandomStream* r) { return draw(r) ? 1. : 0.; }});
}

// The radiance that media add along a ray, from a uniform point and one sample of each light.
double MediaByPoints(const ProbedScene& scene, const Ray& ray, bool scatters, RandomStream* r) {
  const Real t = r->Uniform() * ray.tMax;
  Ray before = ray;
  before.tMax = t;
  const SurfacePoint at{ray(t), Abs(ray(t)) * Gamma(3), Normal3(), ray.time};
  Spectrum source;
  for (const auto& medium : scene.World().Media()) source += medium->At(at.p).emission;
  for (const auto& light : scene.World().Lights()) {
    const Point2 u = NextPoint(r);
    const Real part = r->Uniform();
    if (!scatters || light->IsProvablyBlack()) continue;
    const auto direct = light->SampleDirect(at, u, part);
    if (!direct || scene.World().Occluded(direct->shadowRay)) continue;
    const Spectrum arriving =
        direct->Li * scene.World().Transmittance(direct->shadowRay) / direct->pdf;
    for (const auto& medium : scene.World().Media())
      source += arriving * medium->At(at.p).scattering * medium->Phase(-ray.d, direct->wi);
  }
  return double((source * scene.World().Transmittance(before)).Y() * ray.tMax);
}

void CompareMedia(const ProbedScene& scene, const Sight& sight, EstimateComparison* comparison) {
  VolumeIntegrator* volume = scene.Setup().volumeIntegrator.get();
  if (!volume || !scene.World().HasMedia()) return;
  volume->Preprocess(scene.World());
  Ray ray = sight.ray;
  ray.tMax = sight.hit.hit.t;
  const SampleLayout layout;
  const CameraSamples samples(layout);
  Arena arena;
  RayCounters rays;
  comparison->Add(
      "light of media", .03,
      {24,
       [&](RandomStream* r) {
         LiContext context{scene.World(), samples, arena, rays, r->Bits()};
         return double(volume->Li(ray, context, context.Stream(1)).Y());
       }},
      {64, [&](RandomStream* r) { return MediaByPoints(scene, ray, volume->ScattersLight(), r); }});
}

}  // namespace

std::vector<Comparison> CompareEstimates(const SceneModel& drawn, const Effort& effort) {
  const SceneModel model = SometimesFocused(drawn, effort.sceneSeed);
  // The seed decides the hits too, so it stays the same when a comparison is repeated.
  const ProbedScene scene(SceneText(model, {}), effort.sceneSeed, 24);
  EstimateComparison comparison(effort.firstSeed, effort.factor);
  RandomStream random = scene.Stream(9);
  const auto& sights = scene.Sights();
  const bool comparesPower = !HasStretchedMovingLamp(model);
  Arena arena;
  for (const auto& light : scene.World().Lights()) {
    if (light->IsProvablyBlack()) continue;
    CompareLight(scene, *light, comparesPower, &random, &comparison);
    for (std::size_t i = 0; i < std::min<std::size_t>(2, sights.size()); ++i)
      // A point of a flat lamp lies in the lamp's plane, and rounding decides whether it is seen.
      if (!light->IsDelta() && sights[i].surface.areaLight != light.get())
        CompareLightDensity(scene, *light, sights[i].surface, &comparison);
  }
  for (std::size_t i = 0; i < std::min<std::size_t>(6, sights.size()); ++i)
    if (sights[i].surface.material) CompareBsdfDensity(sights[i], &arena, &comparison);
  for (std::size_t i = 0; i < std::min<std::size_t>(2, sights.size()); ++i)
    CompareMedia(scene, sights[i], &comparison);
  CompareLoneLamp(effort.sceneSeed, &comparison);
  return comparison.Take();
}

}  // namespace exphoton::random_scenes
