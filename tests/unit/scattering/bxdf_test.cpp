// SPDX-License-Identifier: BSD-2-Clause
// These tests check single BSDF lobes: reciprocity, energy, awkward directions, and the stated
// reflectances.
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/albedo_tables.h"
#include "core/scattering/lobes/fresnel_blend.h"
#include "core/scattering/lobes/lafortune.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "gtest/gtest.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

class SmoothLobe : public testing::TestWithParam<NamedLobe> {
 protected:
  const Bxdf& Lobe() const { return *GetParam().lobe; }
};
INSTANTIATE_TEST_SUITE_P(All, SmoothLobe, testing::ValuesIn(SmoothLobes()),
                         [](const auto& info) { return info.param.name; });

Vector3 AnyDirection(RandomStream& random) {
  const Real x = random.Uniform(), y = random.Uniform();
  return SampleUniformSphere({x, y});
}

TEST_P(SmoothLobe, IsReciprocal) {
  RandomStream random(1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 a = AnyDirection(random), b = AnyDirection(random);
    const Spectrum ab = Lobe().f(a, b), ba = Lobe().f(b, a);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(ab[c], ba[c], 1e-4 * double(ab[c]) + 1e-30);
  }
}

TEST_P(SmoothLobe, ServesOneSideOnly) {
  RandomStream random(2);
  const bool transmits = Intersects(Lobe().Lobe(), LobeSet::Transmission);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = AnyDirection(random), b = AnyDirection(random);
    if ((a.z * b.z < 0) == transmits) continue;
    EXPECT_TRUE(Lobe().f(a, b).IsBlack());
    EXPECT_EQ(Lobe().Pdf(a, b), 0);
  }
}

TEST_P(SmoothLobe, NeverReflectsMoreThanItReceives) {
  for (const Vector3& wo : Directions({1, Real(.9), Real(.5), Real(.2), Real(.1), Real(1e-2),
                                       Real(1e-3), Real(1e-6), Real(-.3), -1})) {
    EXPECT_LE(Albedo(Lobe(), wo).MaxComponent(), Real(1.001)) << "cos " << wo.z;
  }
}

// The throughput and density of Sample must agree with f and Pdf.
TEST_P(SmoothLobe, CarriesTheThroughputOfItsValueAndDensity) {
  RandomStream random(3);
  for (const Vector3& wo : Directions({1, Real(.5), Real(.1), Real(1e-3), Real(-.5)})) {
    for (int i = 0; i < 500; ++i) {
      const Real x = random.Uniform(), y = random.Uniform();
      const auto sample = Lobe().Sample(wo, {x, y});
      if (!sample) continue;
      EXPECT_NEAR(LengthSquared(sample->wi), 1, 1e-5);
      const Real pdf = Lobe().Pdf(wo, sample->wi);
      EXPECT_NEAR(pdf, sample->pdf, 2e-2 * double(pdf));
      const Spectrum expected = Lobe().f(wo, sample->wi) * (std::abs(sample->wi.z) / pdf);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sample->throughput[c], expected[c], 2e-2 * double(expected[c]) + 1e-6);
    }
  }
}

// f cos <= bound pdf in every direction, so no sample and no mixture of lobes exceeds the bound. It
// must not be loose either: rejection would draw many candidates.
TEST_P(SmoothLobe, StaysWithinItsThroughputBound) {
  RandomStream random(4);
  for (const Vector3& wo : Directions({1, Real(.9), Real(.5), Real(.1), Real(1e-2), Real(-.5)})) {
    const auto bound = Lobe().ThroughputBound(wo);
    ASSERT_TRUE(bound);
    Spectrum largest;
    for (int i = 0; i < 4000; ++i) {
      const Vector3 any = AnyDirection(random);
      const Real x = random.Uniform(), y = random.Uniform();
      const auto sample = Lobe().Sample(wo, {x, y});
      for (const Vector3& wi : {any, sample ? sample->wi : any}) {
        const Spectrum value = Lobe().f(wo, wi) * std::abs(wi.z);
        const Real pdf = Lobe().Pdf(wo, wi);
        for (int c = 0; c < 3; ++c)
          EXPECT_LE(value[c], (*bound)[c] * pdf * Real(1.001) + Real(1e-6)) << "cos " << wo.z;
      }
      if (!sample) continue;
      for (int c = 0; c < 3; ++c) largest[c] = std::max(largest[c], sample->throughput[c]);
    }
    if (std::abs(wo.z) < Real(.3)) continue;
    EXPECT_LE(bound->MaxComponent(), std::max(8 * largest.MaxComponent(), Real(2)))
        << "cos " << wo.z;
  }
}

TEST_P(SmoothLobe, IsFiniteInEveryDirection) {
  std::vector<Vector3> all = Directions(
      {1, Real(.5), Real(1e-3), Real(1e-6), Real(1e-20), Real(1e-40), 0, Real(-1e-20), -1});
  all.push_back({1, 0, 0});
  all.push_back({-1, 0, 0});
  const std::size_t count = all.size();
  for (std::size_t i = 0; i < count; ++i) all.push_back(-all[i]);
  for (const Vector3& wo : all) {
    for (const Vector3& wi : all) {
      EXPECT_TRUE(Lobe().f(wo, wi).IsFinite()) << wo.z << ' ' << wi.z;
      EXPECT_GE(Lobe().f(wo, wi).MinComponent(), 0);
      EXPECT_TRUE(std::isfinite(Lobe().Pdf(wo, wi))) << wo.z << ' ' << wi.z;
    }
    for (Real x : {Real(0), Real(.5), kOneMinusEpsilon}) {
      for (Real y : {Real(0), Real(.25), kOneMinusEpsilon}) {
        const auto sample = Lobe().Sample(wo, {x, y});
        if (!sample) continue;
        EXPECT_TRUE(IsFinite(sample->wi));
        EXPECT_TRUE(sample->throughput.IsFinite());
        EXPECT_GT(sample->pdf, 0);
        EXPECT_TRUE(std::isfinite(sample->pdf));
      }
    }
  }
}

TEST_P(SmoothLobe, StatesItsHemisphericalReflectance) {
  const Spectrum stated = Lobe().Rho(), truth = HemisphericalAlbedo(Lobe());
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(stated[c], truth[c], .02) << GetParam().name;
    EXPECT_GT(stated[c], 0);
    EXPECT_LE(stated[c], 1);
  }
}

TEST(Lambert, ReflectsExactlyItsReflectance) {
  const Spectrum r(Real(.7), Real(.3), Real(.1));
  EXPECT_EQ(Lambert(r).Rho(), r);
  EXPECT_EQ(Lambert(r).Sample({0, 0, 1}, {Real(.3), Real(.6)})->throughput, r);
  EXPECT_FLOAT_EQ(float(Lambert(r).f({0, 0, 1}, {Real(.6), 0, Real(.8)}).r), float(Real(.7) / kPi));
}

TEST(OrenNayar, WithoutRoughnessIsLambert) {
  const OrenNayar rough(Spectrum(Real(.5)), 0);
  EXPECT_FLOAT_EQ(float(rough.f({0, 0, 1}, {Real(.6), 0, Real(.8)}).r), float(Real(.5) / kPi));
}

// The lobe is brighter back towards the light than away from it.
TEST(OrenNayar, ScattersBackwards) {
  const OrenNayar rough(Spectrum(1), Radians(30));
  const Vector3 w(Real(.8), 0, Real(.6));
  EXPECT_GT(rough.f(w, w).r, rough.f(w, {Real(-.8), 0, Real(.6)}).r * Real(1.2));
}

TEST(Microfacet, AtThePeakIsTheFormula) {
  const Microfacet gloss(Spectrum(1), Fresnel::None(), 10);
  EXPECT_NEAR(gloss.f({0, 0, 1}, {0, 0, 1}).r, 12 / (2 * kPi) / 4, 1e-5);
}

// At normal incidence no microfacet reflects totally. At 60 degrees all relevant microfacets do.
TEST(Microfacet, KeepsTheInvertedFresnelTerm) {
  const Microfacet gloss(Spectrum(1), Fresnel::Dielectric(Real(1.5), 1), 1000);
  const Microfacet white(Spectrum(1), Fresnel::None(), 1000);
  const Vector3 up(0, 0, 1);
  EXPECT_NEAR(gloss.f(up, up).r / white.f(up, up).r, .04, 1e-5);
  const Vector3 a(std::sin(Radians(60)), 0, Real(.5)), b(-a.x, 0, Real(.5));
  EXPECT_EQ(gloss.f(a, b).r, white.f(a, b).r);
}

TEST(Microfacet, RoughnessOutOfRangeIsTheSharpest) {
  EXPECT_EQ(BlinnExponent(0), 1000);
  EXPECT_EQ(BlinnExponent(-1), 1000);
  EXPECT_EQ(BlinnExponent(Real(1e-30)), 1000);
  EXPECT_EQ(BlinnExponent(std::numeric_limits<Real>::quiet_NaN()), 1000);
  EXPECT_FLOAT_EQ(float(BlinnExponent(10)), .1f);
}

// Returns the sine of the polar angle with cosine (1 - u)^(1/n).
double SineOfPower(double u, double n) { return std::sqrt(-std::expm1(2 * std::log1p(-u) / n)); }

// A sine computed from a rounded cosine near 1 has few digits left.
TEST(NarrowLobes, KeepTheDigitsOfDirectionsNearTheirAxis) {
  constexpr double kDigits = 1e-6;
  const Vector3 up(0, 0, 1);
  const auto sineOf = [](const Vector3& v) { return std::hypot(double(v.x), double(v.y)); };
  for (const Real exponent : {Real(10), Real(100), Real(1000)}) {
    const BlendedGloss coat(Spectrum(1), exponent, exponent);
    const LafortuneFit peak{{Spectrum(-1), Spectrum(1), Spectrum(exponent)}};
    const Lafortune fitted(peak);
    for (const Real u : {Real(1e-7), Real(1e-5), Real(1e-3), Real(.1), Real(.3)}) {
      const double blinn = SineOfPower(double(u), double(exponent) + 2);
      EXPECT_NEAR(sineOf(BlinnDistribution(exponent).Sample({u, Real(.1)})) / blinn, 1, kDigits);
      const double half = SineOfPower(double(u), double(exponent) + 1);
      const double mirrored = 2 * half * std::sqrt(1 - half * half);
      EXPECT_NEAR(sineOf(coat.Sample(up, {u, Real(.1)})->wi) / mirrored, 1, kDigits);
      // The three channels take a third of the first variate each.
      const double lobe = SineOfPower(3 * double(u), double(exponent) + 1);
      EXPECT_NEAR(sineOf(fitted.Sample(up, {u, Real(.1)})->wi) / lobe, 1, kDigits);
    }
  }
}

// The centre of the highlight must be its brightest place.
TEST(FresnelBlend, HasNoHoleAtThePeak) {
  const BlendedGloss blend(Spectrum(1), 50, 200);
  const Vector3 up(0, 0, 1);
  const Vector3 near = Normalize(Vector3(Real(1e-3), 0, 1));
  EXPECT_NEAR(blend.f(up, up).r, blend.f(up, near).r, Real(1e-3) * blend.f(up, up).r);
  EXPECT_NEAR(blend.f(up, up).r, std::sqrt(Real(52) * 202) / (2 * kPi) / 4, 1e-3);
}

TEST(FresnelBlend, IsNarrowerAlongTheLargerExponent) {
  const BlendedGloss blend(Spectrum(1), 10, 500);
  const Vector3 up(0, 0, 1);
  EXPECT_GT(blend.f(up, {Real(.3), 0, SafeSqrt(Real(.91))}).r,
            4 * blend.f(up, {0, Real(.3), SafeSqrt(Real(.91))}).r);
}

TEST(FresnelBlend, CoatAboveOneTakesNoLightFromTheBase) {
  const BlendedDiffuse blend(Spectrum(1), Spectrum(4));
  RandomStream random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = AnyDirection(random), b = AnyDirection(random);
    EXPECT_GE(blend.f(a, b).MinComponent(), 0);
  }
}

// The table's hemispherical albedo must agree with another quadrature rule than the one that
// made the table.
TEST(AlbedoTables, AgreeWithAnIndependentQuadrature) {
  for (Real exponent : {Real(.5), Real(7), Real(90), Real(1000)}) {
    const Microfacet white(Spectrum(1), Fresnel::None(), exponent);
    EXPECT_NEAR(white.Rho().r, HemisphericalAlbedo(white, 32).r, .005) << exponent;
    const Microfacet total(Spectrum(1), Fresnel::Dielectric(Real(1.5), 1), exponent);
    EXPECT_NEAR(total.Rho().r, HemisphericalAlbedo(total, 32).r, .015) << exponent;
  }
}

}  // namespace
}  // namespace exphoton
