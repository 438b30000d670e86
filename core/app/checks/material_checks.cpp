// SPDX-License-Identifier: BSD-2-Clause
// CheckMaterial: every check takes its own random numbers. Smooth lobes are compared direction by
// direction, and mirrors and glass by means of their samples.
#include "core/app/checks/material_checks.h"

#include <algorithm>

#include "core/app/checks/chi_square.h"
#include "core/app/checks/flat_surface.h"
#include "core/base/arena.h"
#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

double Largest(const Spectrum& s) { return double(s.MaxComponent()); }

// A function of a direction, to weigh the light that arrives or leaves.
using Pattern = double (*)(const Vector3& w);
double Everywhere(const Vector3&) { return 1; }
double ToOneSide(const Vector3& w) { return w.x > 0 ? 1 : 0; }
double Grazing(const Vector3& w) { return std::abs(w.z) < Real(.3) ? 1 : 0; }

class MaterialChecker {
 public:
  MaterialChecker(const Material& material, std::uint64_t seed)
      : seed_(seed),
        radiance_(Evaluate(material, TransportMode::Radiance)),
        importance_(Evaluate(material, TransportMode::Importance)) {}

  Checks Run() {
    CheckEnergy();
    if (radiance_.Has(LobeSet::NonSpecular)) {
      CheckDensity();
      CheckValues();
      CheckReciprocity();
    } else {
      checks_.notes.push_back("no smooth lobe: densities and reciprocity are not checked");
    }
    CheckAdjointness();
    return std::move(checks_);
  }

 private:
  Bsdf Evaluate(const Material& material, TransportMode mode) {
    SurfaceInteraction si = FlatSurface();
    return material.Evaluate(&si, mode, &arena_);
  }

  // White furnace: under light of 1 from everywhere, a surface must not scatter more than 1.
  void CheckEnergy() {
    constexpr double kMost = 1.005;
    double largest = 0;
    for (const Vector3& wo : Directions({1, Real(.8), Real(.4), Real(.1), Real(-.6)})) {
      for (int c = 0; c < 3; ++c) {
        const MeanOfSeeds scattered =
            MeanOfSeeds::Of(seed_ + 1, [&](std::uint64_t seed) { return Scattered(wo, c, seed); });
        largest = std::max(largest, scattered.mean - 4 * scattered.error);
      }
    }
    checks_.AtMost("energy", largest, kMost, "largest share of light that is scattered");
    if (largest > kMost)
      checks_.notes.push_back(
          "energy: where colours add up to more than 1, as some defaults do, give smaller ones, "
          "such as '\"color Kd\" [.4 .4 .4]'");
  }

  double Scattered(const Vector3& wo, int channel, std::uint64_t seed) const {
    constexpr int kSide = 64;
    RandomStream random(seed);
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Point2 u = Stratified(i, kSide, &random);
      const auto sample =
          importance_.Sample(wo, u, random.Uniform(), LobeSet::All, TransportMode::Importance);
      if (sample) sum += double(sample->throughput[channel]);
    }
    return sum / (kSide * kSide);
  }

  static Point2 Stratified(int i, int side, RandomStream* random) {
    const Real x = (Real(i % side) + random->Uniform()) / Real(side);
    const Real y = (Real(i / side) + random->Uniform()) / Real(side);
    return {std::min(x, kOneMinusEpsilon), std::min(y, kOneMinusEpsilon)};
  }

  void CheckDensity() {
    double least = 1, mass = 0, impossible = 0;
    const auto directions = Directions({Real(.9), Real(.3), Real(-.5)});
    for (const Vector3& wo : directions) {
      const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
        const Real x = random.Uniform(), y = random.Uniform();
        const auto found = radiance_.Sample(wo, {x, y}, random.Uniform());
        if (!found || found->IsSpecular()) return std::nullopt;
        return OffHorizon(found->wi);
      };
      const auto pdf = [&](const Vector3& wi) { return double(radiance_.Pdf(wo, wi)); };
      ChiSquareOptions options;
      options.samples = 20000;
      options.quadratureDepth = 6;
      options.seed = seed_ + 2;
      const ChiSquareResult result = TestDirections({}, sample, pdf, options);
      least = std::min(least, result.pValue);
      mass = std::max(mass, result.mass);
      impossible = std::max(impossible, double(result.impossible) / result.samples);
    }
    checks_.AtLeast("density", least, SignificanceOf(kFalseAlarms, int(directions.size())),
                    "p-value of samples against Pdf");
    checks_.AtMost("density integral", mass, 1.005, "integral of Pdf over directions");
    checks_.AtMost("support", impossible, .002, "share of samples where Pdf is 0");
  }

  // Throughput is f |cos| / pdf, and the stated pdf equals Pdf.
  void CheckValues() {
    RandomStream random(seed_ + 3);
    int wrong = 0, count = 0;
    for (const Vector3& wo : Directions({Real(.9), Real(.3), Real(-.5)})) {
      for (int i = 0; i < 4000; ++i) {
        const Point2 u{random.Uniform(), random.Uniform()};
        const auto sample = radiance_.Sample(wo, u, random.Uniform());
        if (!sample || sample->IsSpecular() || std::abs(sample->wi.z) < Real(1e-3)) continue;
        ++count;
        const BsdfValue value = radiance_.Evaluate(wo, sample->wi, LobeSet::All);
        const Spectrum expected = value.f * (std::abs(sample->wi.z) / value.pdf);
        const double scale = std::max({Largest(expected), Largest(sample->throughput), 1e-6});
        bool isWrong = std::abs(sample->pdf - value.pdf) > Real(.01) * value.pdf;
        for (int c = 0; c < 3; ++c)
          isWrong |= !(std::abs(double(sample->throughput[c] - expected[c])) <= .01 * scale);
        wrong += isWrong;
      }
    }
    checks_.AtMost("sample values", count == 0 ? 0 : double(wrong) / count, .002,
                   "share of samples that contradict f or Pdf");
  }

  void CheckReciprocity() {
    RandomStream random(seed_ + 4);
    double largest = 0, peak = 0;
    for (int i = 0; i < 4000; ++i) {
      const Vector3 a = SampleUniformSphere({random.Uniform(), random.Uniform()});
      const Vector3 b = SampleUniformSphere({random.Uniform(), random.Uniform()});
      if (std::abs(a.z) < Real(.02) || std::abs(b.z) < Real(.02)) continue;
      const Spectrum there = radiance_.f(a, b), back = radiance_.f(b, a);
      peak = std::max({peak, Largest(there), Largest(back)});
      for (int c = 0; c < 3; ++c) {
        const double sum = double(there[c] + back[c]);
        if (sum > 1e-4 * peak)
          largest = std::max(largest, std::abs(double(there[c] - back[c])) / sum);
      }
    }
    checks_.AtMost("reciprocity", largest, .01, "largest |f(a,b) - f(b,a)| over their sum");
  }

  // The light that goes from pattern h to pattern g is the same for cameras, which sample wi for a
  // given wo, as for photons. Refraction scales radiance, so the two modes differ in each sample.
  void CheckAdjointness() {
    struct Pair {
      Pattern g, h;
    };
    double largest = 0;
    for (const Pair& pair : {Pair{Everywhere, Everywhere}, Pair{ToOneSide, Grazing},
                             Pair{Grazing, Everywhere}, Pair{Everywhere, ToOneSide}}) {
      const MeanOfSeeds difference = MeanOfSeeds::Of(seed_ + 5, [&](std::uint64_t seed) {
        RandomStream random(seed);
        return Carried(radiance_, TransportMode::Radiance, pair.g, pair.h, &random) -
               Carried(importance_, TransportMode::Importance, pair.h, pair.g, &random);
      });
      largest = std::max(largest, std::abs(difference.mean) - 4 * difference.error);
    }
    checks_.AtMost("adjointness", std::max(largest, 0.), .01,
                   "what cameras see less what photons carry");
  }

  // Draws directions by their cosine over both sides.
  static double Carried(const Bsdf& bsdf, TransportMode mode, Pattern from, Pattern to,
                        RandomStream* random) {
    constexpr int kSide = 100;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      Vector3 w = SampleCosineHemisphere(Stratified(i, kSide, random));
      if (random->Uniform() < Real(.5)) w.z = -w.z;
      const Point2 u{random->Uniform(), random->Uniform()};
      const auto sample = bsdf.Sample(w, u, random->Uniform(), LobeSet::All, mode);
      if (!sample) continue;
      const Spectrum& t = sample->throughput;
      sum += from(w) * to(sample->wi) * double(t.r + t.g + t.b) / 3;
    }
    return 2 * sum / (kSide * kSide);
  }

  std::uint64_t seed_;
  Arena arena_;
  Bsdf radiance_, importance_;
  Checks checks_;
};

}  // namespace

Checks CheckMaterial(const Material& material, std::uint64_t seed) {
  return MaterialChecker(material, seed).Run();
}

}  // namespace exphoton
