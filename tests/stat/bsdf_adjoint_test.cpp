// SPDX-License-Identifier: BSD-2-Clause
// These tests check the factor by which photons carry the light that cameras see under a shading
// normal. The integral of g(wo) |wo.ng| f(wo, wi) |wi.ns| h(wi) over both directions must be the
// same from wo, as camera paths sample it, and from wi, as photons do (Veach 1997, section 5.3),
// for patterns g and h. photon_shading_test.cpp checks that photons are shot with this factor.
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/transmitted.h"
#include "core/transport/shading_normal.h"
#include "tests/support/equivalence.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

using Pattern = double (*)(const Vector3& w);

struct Form {
  const Bsdf& bsdf;
  Pattern g, h;

  // Draws one direction by its cosine to the geometric normal, over both sides of the surface.
  double FromCamera(RandomStream* random) const {
    return Mean(
        random,
        [this](const Vector3& wo, const BsdfSample& sample) {
          return g(wo) * double(sample.throughput.r) * h(sample.wi);
        },
        TransportMode::Radiance);
  }
  double FromLight(RandomStream* random) const {
    return Mean(
        random,
        [this](const Vector3& wi, const BsdfSample& sample) {
          const Real factor = ShadingNormalFactor(wi, sample.wi, bsdf.Ng(), bsdf.Ns());
          return h(wi) * double(sample.throughput.r * factor) * g(sample.wi);
        },
        TransportMode::Importance);
  }

 private:
  template <class Value>
  double Mean(RandomStream* random, Value&& value, TransportMode mode) const {
    constexpr int kSide = 800;  // strata of the first direction, along each axis
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Real x = (Real(i % kSide) + random->Uniform()) / kSide;
      const Real y = (Real(i / kSide) + random->Uniform()) / kSide;
      const bool isBelow = random->Uniform() < Real(.5);
      Vector3 w = SampleCosineHemisphere({std::min(x, kOneMinusEpsilon), y});
      if (isBelow) w.z = -w.z;
      const Point2 u{random->Uniform(), random->Uniform()};
      const auto sample = bsdf.Sample(w, u, random->Uniform(), LobeSet::All, mode);
      if (sample) sum += value(w, *sample);
    }
    return 2 * sum / (kSide * kSide);
  }
};

double Everywhere(const Vector3&) { return 1; }
double TowardsTilt(const Vector3& w) { return w.x > 0 ? 1 : 0; }
double AwayFromTilt(const Vector3& w) { return w.x < 0 ? 1 : 0; }
double Grazing(const Vector3& w) { return std::abs(w.z) < Real(.3) ? 1 : 0; }

struct Patterns {
  const char* name;
  Pattern g, h;
};
constexpr Patterns kPatterns[] = {{"everywhere", Everywhere, Everywhere},
                                  {"along the tilt", AwayFromTilt, TowardsTilt},
                                  {"to grazing views", Grazing, Everywhere},
                                  {"from grazing light", Everywhere, Grazing}};

// The total incident light is 2, or less under a pattern. The tolerance is absolute.
void ExpectEqual(const Bsdf& bsdf, double tolerance) {
  for (const Patterns& patterns : kPatterns) {
    const Form form{bsdf, patterns.g, patterns.h};
    const SeedEstimate difference = EstimateOverSeeds([&](std::uint64_t seed) {
      RandomStream camera(seed), light(seed + 500);
      return form.FromLight(&light) - form.FromCamera(&camera);
    });
    EXPECT_TRUE(IsWithinAbsolute(tolerance, difference, 0)) << patterns.name;
  }
}

constexpr Real kTilt = Real(.3);  // 17 degrees

TEST(BsdfAdjoint, OfADiffuseBumpIsWhatTheFactorMakesEqual) {
  const Lambert white(Spectrum(1));
  Bsdf bsdf(TiltedSurface(kTilt));
  bsdf.Add(&white);
  ExpectEqual(bsdf, .01);
}

TEST(BsdfAdjoint, OfALeafAndAGlossIsWhatTheFactorMakesEqual) {
  const Lambert front{Spectrum(Real(.4))};
  const Transmitted<Lambert> through{Lambert(Spectrum(Real(.3)))};
  const Microfacet gloss{Spectrum(Real(.3)), Fresnel::None(), 5};
  Bsdf bsdf(TiltedSurface(kTilt));
  for (const Bxdf* lobe : {static_cast<const Bxdf*>(&front), static_cast<const Bxdf*>(&through),
                           static_cast<const Bxdf*>(&gloss)})
    bsdf.Add(lobe);
  ExpectEqual(bsdf, .01);
}

}  // namespace
}  // namespace exphoton
