// SPDX-License-Identifier: BSD-2-Clause
// CheckLight: shadows play no part, because the flux through a sphere round the light, or round the
// world, is the power that leaves the light.
#include "core/app/checks/light_checks.h"

#include <algorithm>

#include "core/app/checks/chi_square.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

double Mean(const Spectrum& s) { return double(s.r + s.g + s.b) / 3; }

double RelativeDifference(double a, double b) {
  const double largest = std::max(std::abs(a), std::abs(b));
  return largest > 0 ? std::abs(a - b) / largest : 0;
}

class LightChecker {
 public:
  LightChecker(const Scene& scene, std::uint64_t seed)
      : scene_(scene),
        light_(*scene.Lights().at(0)),
        area_(dynamic_cast<const AreaLight*>(&light_)),
        world_(BoundingSphere(scene.WorldBounds())),
        seed_(seed) {}

  Checks Run() {
    CheckEmission();
    if (light_.IsDelta()) {
      checks_.notes.push_back("no ray can hit this light: PdfDirect and radiance are not checked");
    } else {
      CheckDirectDensity();
      CheckDirectValues();
    }
    CheckPower();
    return std::move(checks_);
  }

 private:
  std::optional<LightLeSample> Emit(RandomStream& random) const {
    const Point2 position{random.Uniform(), random.Uniform()};
    const Point2 direction{random.Uniform(), random.Uniform()};
    return light_.SampleEmission(position, direction, random.Uniform(), 0);
  }

  void AddDensity(const std::string& name, const ChiSquareResult& result, const std::string& of) {
    checks_.AtLeast(name + " density", result.pValue, SignificanceOf(kFalseAlarms, 2),
                    "p-value of samples against " + of);
    checks_.AtMost(name + " integral", result.mass, 1.005, "integral of " + of);
    checks_.AtMost(name + " support", double(result.impossible) / result.samples, .002,
                   "share of samples where " + of + " is 0");
  }

  // Directions of photons, for an area light those from one point.
  void CheckEmission() {
    const Point2 position(Real(.3), Real(.6));
    const auto emit = [&](RandomStream& random) {
      const Point2 direction{random.Uniform(), random.Uniform()};
      return area_ ? light_.SampleEmission(position, direction, Real(.4), 0) : Emit(random);
    };
    RandomStream first(seed_);
    std::optional<LightLeSample> one;
    for (int i = 0; i < 1000 && !one; ++i) one = emit(first);
    if (!one) return checks_.notes.push_back("1000 emission samples are without light");
    SurfacePoint from;
    from.p = one->ray.o;
    from.ng = NormalizeOr(from.p - world_.center, {0, 0, 1});
    if (!(light_.PdfEmission(from, one->ray.d).direction > 0)) {
      checks_.notes.push_back("PdfEmission is 0: emitted directions are not checked");
      return;
    }
    const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
      const auto emission = emit(random);
      if (!emission) return std::nullopt;
      return emission->ray.d;
    };
    const auto pdf = [&](const Vector3& w) {
      return double(light_.PdfEmission(from, w).direction);
    };
    AddDensity("emission", TestDirections({}, sample, pdf, Options()), "PdfEmission");
  }

  ChiSquareOptions Options() const {
    ChiSquareOptions options;
    options.samples = 40000;
    options.quadratureDepth = 5;  // maps have edges
    options.seed = seed_ + 1;
    return options;
  }

  // A point outside of the sphere that carries an area light.
  SurfacePoint Reference() const {
    SurfacePoint ref;
    ref.p = world_.center + Vector3(Real(1.2), Real(-.9), 2) * world_.radius;
    ref.ng = NormalizeOr(world_.center - ref.p, {0, 0, 1});
    return ref;
  }

  Real PdfDirect(const SurfacePoint& ref, const Vector3& w) const {
    if (!area_) return light_.PdfDirect(ref, w, nullptr);
    const auto on = scene_.Intersect(RayFrom(ref, w));
    return on ? light_.PdfDirect(ref, w, &*on) : 0;
  }

  static RayDifferential RayFrom(const SurfacePoint& ref, const Vector3& w) {
    RayDifferential ray;
    ray.o = ref.p;
    ray.d = w;
    return ray;
  }

  void CheckDirectDensity() {
    const SurfacePoint ref = Reference();
    DirectionGrid grid;
    if (area_) {
      const double sine = double(world_.radius / Length(world_.center - ref.p));
      grid = {world_.center - ref.p, 1 - std::sqrt(std::max(1 - sine * sine, 0.))};
    }
    const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
      const Point2 u{random.Uniform(), random.Uniform()};
      const auto direct = light_.SampleDirect(ref, u, random.Uniform());
      if (!direct) return std::nullopt;
      return direct->wi;
    };
    const auto pdf = [&](const Vector3& w) { return double(PdfDirect(ref, w)); };
    ChiSquareOptions options = Options();
    if (area_) options.rows = 10, options.columns = 16;
    AddDensity("direct", TestDirections(grid, sample, pdf, options), "PdfDirect");
  }

  // A sample states the density and the radiance that a ray in its direction finds.
  void CheckDirectValues() {
    const SurfacePoint ref = Reference();
    RandomStream random(seed_ + 2);
    int wrong = 0, count = 0;
    for (int i = 0; i < 4000; ++i) {
      const Point2 u{random.Uniform(), random.Uniform()};
      const auto direct = light_.SampleDirect(ref, u, random.Uniform());
      if (!direct) continue;
      ++count;
      Spectrum radiance = light_.Le(direct->wi);
      if (area_) {
        const auto on = scene_.Intersect(RayFrom(ref, direct->wi));
        radiance = on ? area_->L(*on, on->uv, on->wo) : Spectrum();
      }
      const double pdf = double(PdfDirect(ref, direct->wi));
      wrong += RelativeDifference(pdf, double(direct->pdf)) > .01 ||
               RelativeDifference(Mean(radiance), Mean(direct->Li)) > .01;
    }
    checks_.AtMost("direct values", count == 0 ? 1 : double(wrong) / count, .002,
                   "share of samples that a ray contradicts");
  }

  void CheckPower() {
    const MeanOfSeeds emitted =
        MeanOfSeeds::Of(seed_ + 3, [&](std::uint64_t seed) { return EmittedPower(seed); });
    const MeanOfSeeds arriving =
        MeanOfSeeds::Of(seed_ + 4, [&](std::uint64_t seed) { return ArrivingPower(seed); });
    const double noise = 4 * std::hypot(emitted.error, arriving.error);
    const double scale = std::max({emitted.mean, arriving.mean, 1e-30});
    checks_.AtMost("power", std::max(std::abs(emitted.mean - arriving.mean) - noise, 0.) / scale,
                   .01, "power of photons against arriving flux");
    checks_.AtMost("stated power", RelativeDifference(emitted.mean, Mean(light_.Power())), .6,
                   "power of photons against Power()");
    if (const auto bound = light_.EmissionBound())
      checks_.AtMost("emission bound", largest_ / double(*bound), 1.001,
                     "largest photon over EmissionBound()");
  }

  double EmittedPower(std::uint64_t seed) {
    RandomStream random(seed);
    constexpr int kSamples = 30000;
    double sum = 0;
    for (int i = 0; i < kSamples; ++i) {
      const auto emission = Emit(random);
      if (!emission) continue;
      sum += Mean(emission->power);
      largest_ = std::max(largest_, double(emission->power.Y()));
    }
    return sum / kSamples;
  }

  // Returns the flux through a sphere: of light from inside, or from outside for a distant light.
  double ArrivingPower(std::uint64_t seed) const {
    RandomStream random(seed);
    constexpr int kSide = 150;
    const auto bounds = light_.Bounds();
    Sphere3 sphere = world_;
    if (bounds) {
      sphere = BoundingSphere(*bounds);
      sphere.radius = sphere.radius > 0 ? sphere.radius * Real(1.5) : 1;
    }
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Real x = (Real(i % kSide) + random.Uniform()) / kSide;
      const Real y = (Real(i / kSide) + random.Uniform()) / kSide;
      const Vector3 out = SampleUniformSphere({std::min(x, kOneMinusEpsilon), y});
      SurfacePoint ref;
      ref.p = sphere.center + out * sphere.radius;
      ref.ng = bounds ? -out : out;
      const Point2 u{random.Uniform(), random.Uniform()};
      const auto direct = light_.SampleDirect(ref, u, random.Uniform());
      if (!direct) continue;
      const double cosine = double(Dot(direct->wi, ref.ng));
      if (cosine > 0) sum += Mean(direct->Li) * cosine / double(direct->pdf);
    }
    const double radius = double(sphere.radius);
    return sum / (kSide * kSide) * 4 * M_PI * radius * radius;
  }

  const Scene& scene_;
  const Light& light_;
  const AreaLight* area_;
  Sphere3 world_;
  std::uint64_t seed_;
  double largest_ = 0;
  Checks checks_;
};

}  // namespace

Checks CheckLight(const Scene& scene, std::uint64_t seed) {
  return LightChecker(scene, seed).Run();
}

}  // namespace exphoton
