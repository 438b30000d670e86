// SPDX-License-Identifier: BSD-2-Clause
// These tests check the BSDF at a point: masks, weights, sides and frames.
#include "core/scattering/bsdf.h"

#include "core/base/arena.h"
#include "core/base/error.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/lambert.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/specular.h"
#include "core/scattering/lobes/transmitted.h"
#include "gtest/gtest.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

const Lambert kDiffuse{Spectrum(Real(.5))};
const Microfacet kGloss{Spectrum(1), Fresnel::None(), 20};
const Transmitted<Lambert> kThrough{Lambert(Spectrum(Real(.25)))};
const SpecularReflection kMirror{Spectrum(Real(.3)), Fresnel::None()};
const Vector3 kOut = Normalize(Vector3(1, 2, 3));

Bsdf Make(std::initializer_list<const Bxdf*> lobes, const SurfaceInteraction& si = FlatSurface()) {
  Bsdf bsdf(si);
  for (const Bxdf* lobe : lobes) bsdf.Add(lobe);
  return bsdf;
}

TEST(Bsdf, WithoutLobesScattersNothing) {
  const Bsdf bsdf = Make({});
  EXPECT_EQ(bsdf.Count(), 0);
  EXPECT_FALSE(bsdf.Has(LobeSet::All));
  EXPECT_TRUE(bsdf.f(kOut, kOut).IsBlack());
  EXPECT_EQ(bsdf.Pdf(kOut, kOut), 0);
  EXPECT_FALSE(bsdf.Sample(kOut, {Real(.5), Real(.5)}, 0));
  EXPECT_TRUE(bsdf.Rho(LobeSet::All).IsBlack());
}

TEST(Bsdf, RefusesMoreLobesThanItHolds) {
  Bsdf bsdf(FlatSurface());
  bsdf.Add(nullptr);
  for (int i = 0; i < Bsdf::kMaxLobes; ++i) bsdf.Add(&kDiffuse);
  EXPECT_THROW(bsdf.Add(&kDiffuse), Error);
  EXPECT_EQ(bsdf.Count(), Bsdf::kMaxLobes);
}

TEST(Bsdf, CountsLobesUnderAMask) {
  const Bsdf bsdf = Make({&kDiffuse, &kGloss, &kThrough, &kMirror});
  EXPECT_EQ(bsdf.Count(), 4);
  EXPECT_EQ(bsdf.Count(LobeSet::NonSpecular), 3);
  EXPECT_EQ(bsdf.Count(LobeSet::NonSpecularReflection), 2);
  EXPECT_EQ(bsdf.Count(LobeSet::Transmission), 1);
  EXPECT_FALSE(bsdf.Has(LobeSet::SpecularTransmission));
}

// A gather over smooth lobes must ignore the mirror lobe of a surface.
TEST(Bsdf, UnderASmoothMaskAMirrorChangesNothing) {
  const Bsdf both = Make({&kDiffuse, &kMirror}), plain = Make({&kDiffuse});
  const LobeSet mask = LobeSet::NonSpecular;
  RandomStream random(1);
  for (int i = 0; i < 100; ++i) {
    const Real x = random.Uniform(), y = random.Uniform();
    const auto a = both.Sample(kOut, {x, y}, random.Uniform(), mask);
    const auto b = plain.Sample(kOut, {x, y}, 0, mask);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->wi, b->wi);
    EXPECT_EQ(a->throughput, Spectrum(Real(.5)));
    EXPECT_EQ(a->pdf, b->pdf);
    EXPECT_EQ(both.Pdf(kOut, a->wi, mask), plain.Pdf(kOut, a->wi, mask));
    EXPECT_EQ(both.f(kOut, a->wi, mask), plain.f(kOut, a->wi, mask));
  }
  EXPECT_EQ(both.Rho(mask), Spectrum(Real(.5)));
}

TEST(Bsdf, UnderAFullMaskTheMirrorTakesItsShare) {
  const Bsdf both = Make({&kDiffuse, &kMirror});
  int mirrored = 0;
  for (int i = 0; i < 100; ++i) {
    const auto sample = both.Sample(kOut, {Real(.4), Real(.2)}, (Real(i) + Real(.5)) / 100);
    ASSERT_TRUE(sample);
    mirrored += sample->IsSpecular();
    EXPECT_NEAR(sample->throughput.r, sample->IsSpecular() ? .6 : 1, 1e-6);
    if (sample->IsSpecular()) {
      EXPECT_EQ(sample->pdf, Real(.5));
    } else {
      EXPECT_NEAR(sample->pdf, both.Pdf(kOut, sample->wi), 1e-6);
      EXPECT_NEAR(both.Pdf(kOut, sample->wi), .5 * double(sample->wi.z) / double(kPi), 1e-6);
    }
  }
  EXPECT_EQ(mirrored, 50);
}

TEST(Bsdf, ThroughputIsTheSumOverLobesByTheMeanDensity) {
  const Bsdf bsdf = Make({&kDiffuse, &kGloss, &kThrough, &kMirror});
  RandomStream random(2);
  for (LobeSet mask : {LobeSet::All, LobeSet::NonSpecular, LobeSet::Reflection,
                       LobeSet::GlossyReflection | LobeSet::DiffuseTransmission}) {
    for (int i = 0; i < 300; ++i) {
      const Real x = random.Uniform(), y = random.Uniform();
      const auto sample = bsdf.Sample(kOut, {x, y}, random.Uniform(), mask);
      if (!sample || sample->IsSpecular()) continue;
      EXPECT_EQ(sample->IsTransmission(), sample->wi.z < 0);
      const Real pdf = bsdf.Pdf(kOut, sample->wi, mask);
      EXPECT_NEAR(sample->pdf, pdf, 1e-4 * double(pdf));
      const Real expected = bsdf.f(kOut, sample->wi, mask).r * std::abs(sample->wi.z) / pdf;
      EXPECT_NEAR(sample->throughput.r, expected, 1e-3 * double(expected));
    }
  }
}

TEST(Bsdf, EvaluatesValueAndDensityTogetherAsApart) {
  const Bsdf bsdf = Make({&kDiffuse, &kGloss, &kThrough, &kMirror});
  RandomStream random(4);
  for (LobeSet mask :
       {LobeSet::All, LobeSet::NonSpecular, LobeSet::GlossyReflection, LobeSet::Specular}) {
    for (int i = 0; i < 100; ++i) {
      const Vector3 wi = SampleUniformSphere({random.Uniform(), random.Uniform()});
      const BsdfValue value = bsdf.Evaluate(kOut, wi, mask);
      EXPECT_EQ(value.f, bsdf.f(kOut, wi, mask));
      EXPECT_EQ(value.pdf, bsdf.Pdf(kOut, wi, mask));
    }
  }
}

// Photons in glass are reflected with the probability of Fresnel's reflectance. Each keeps
// its full power.
TEST(Bsdf, ChoosesAmongSpecularLobesByWhatTheyCarry) {
  const SpecularReflection reflection(Spectrum(1), Fresnel::Dielectric(1, Real(1.5)));
  const SpecularTransmission transmission(Spectrum(1), 1, Real(1.5), TransportMode::Importance);
  const Bsdf glass = Make({&reflection, &transmission});
  int reflected = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto sample = glass.Sample({0, 0, 1}, {}, (Real(i) + Real(.5)) / 1000);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(sample->throughput.r, 1, 1e-5);
    EXPECT_NEAR(sample->pdf, sample->IsTransmission() ? .96 : .04, 1e-5);
    reflected += !sample->IsTransmission();
  }
  EXPECT_NEAR(reflected, 40, 1);
}

TEST(Bsdf, AtTotalReflectionGlassReflectsEverything) {
  const SpecularReflection reflection(Spectrum(1), Fresnel::Dielectric(1, Real(1.5)));
  const SpecularTransmission transmission(Spectrum(1), 1, Real(1.5), TransportMode::Radiance);
  const Bsdf glass = Make({&reflection, &transmission});
  for (Real u : {Real(0), Real(.5), kOneMinusEpsilon}) {
    const auto sample = glass.Sample(Directions({Real(-.2)})[0], {}, u);
    ASSERT_TRUE(sample);
    EXPECT_FALSE(sample->IsTransmission());
    EXPECT_EQ(sample->throughput, Spectrum(1));
  }
}

TEST(Bsdf, InTheSurfaceScattersNothing) {
  const Bsdf bsdf = Make({&kDiffuse, &kGloss, &kThrough, &kMirror});
  const Vector3 flat(1, 0, 0);
  EXPECT_TRUE(bsdf.f(flat, kOut).IsBlack());
  EXPECT_TRUE(bsdf.f(kOut, flat).IsBlack());
  EXPECT_EQ(bsdf.Pdf(kOut, flat), 0);
  EXPECT_FALSE(bsdf.Sample(flat, {Real(.5), Real(.5)}, Real(.1)));
}

// Light in front of the geometric surface must never be transmitted, with any shading normal.
TEST(Bsdf, SidesAreThoseOfTheGeometricNormal) {
  const Bsdf bsdf = Make({&kDiffuse, &kGloss, &kMirror}, TiltedSurface(1));
  RandomStream random(3);
  for (int i = 0; i < 3000; ++i) {
    const Real a = random.Uniform(), b = random.Uniform();
    const Vector3 wo = SampleUniformSphere({a, b});
    const Real x = random.Uniform(), y = random.Uniform();
    const Vector3 wi = SampleUniformSphere({y, x});
    if (wo.z * wi.z < 0) {
      EXPECT_TRUE(bsdf.f(wo, wi).IsBlack());
      EXPECT_EQ(bsdf.Pdf(wo, wi), 0);
    }
    const auto sample = bsdf.Sample(wo, {x, y}, random.Uniform());
    if (sample) {
      EXPECT_GT(sample->wi.z * wo.z, 0);
    }
  }
}

TEST(Bsdf, SeenFromBehindItsShadingNormalIsNotBlack) {
  const Bsdf bsdf = Make({&kDiffuse}, TiltedSurface(1));
  const Vector3 wo = Normalize(Vector3(Real(-.99), 0, Real(.14)));  // above ng, below ns
  ASSERT_LT(Dot(wo, bsdf.Ns()), 0);
  EXPECT_GT(bsdf.f(wo, {0, 0, 1}).r, 0);
  int found = 0;
  for (int i = 0; i < 16; ++i)
    found += bsdf.Sample(wo, {(Real(i % 4) + Real(.5)) / 4, (Real(i / 4) + Real(.5)) / 4}, 0)
                 .has_value();
  EXPECT_GT(found, 8);
}

// A direction above the geometric surface and below the horizon of the shading normal.
const Vector3 kBetween = Normalize(Vector3(Real(-.99), 0, Real(.14)));

TEST(Bsdf, ScattersDiffuseLightBetweenItsNormalsByTheAbsoluteCosine) {
  const Bsdf bsdf = Make({&kDiffuse}, TiltedSurface(1));
  ASSERT_LT(Dot(kBetween, bsdf.Ns()), 0);
  for (const Vector3& other : {kOut, Vector3(0, 0, 1), kBetween}) {
    EXPECT_NEAR(bsdf.f(other, kBetween).r, .5 / M_PI, 1e-6);
    EXPECT_EQ(bsdf.f(other, kBetween), bsdf.f(kBetween, other));
    EXPECT_NEAR(bsdf.Pdf(other, kBetween), AbsDot(kBetween, bsdf.Ns()) / kPi, 1e-6);
  }
}

TEST(Bsdf, ReflectsNoGlossFromBetweenItsNormals) {
  const Bsdf bsdf = Make({&kGloss}, TiltedSurface(1));
  EXPECT_TRUE(bsdf.f(kOut, kBetween).IsBlack());
  EXPECT_EQ(bsdf.Pdf(kOut, kBetween), 0);
  EXPECT_GT(bsdf.f(kBetween, kOut).r, 0);  // seen from there, it shines
  RandomStream random(1);
  int seen = 0, photons = 0;
  for (int i = 0; i < 100; ++i) {
    const Real x = random.Uniform(), y = random.Uniform();
    const auto sample = bsdf.Sample(kBetween, {x, y}, 0);
    seen += sample.has_value();
    if (sample) {
      EXPECT_GT(Dot(sample->wi, bsdf.Ns()), 0);
    }
    photons +=
        bsdf.Sample(kBetween, {x, y}, 0, LobeSet::All, TransportMode::Importance).has_value();
  }
  EXPECT_GT(seen, 20);
  EXPECT_EQ(photons, 0);
}

// About the shading normal, a mirror would reflect this view to the back.
TEST(Bsdf, AMirrorSeenFromBetweenItsNormalsReflectsAboutTheGeometricNormal) {
  const Bsdf bsdf = Make({&kMirror}, TiltedSurface(1));
  for (const Vector3& wo : {kBetween, -kBetween}) {
    for (const TransportMode mode : {TransportMode::Radiance, TransportMode::Importance}) {
      const auto sample = bsdf.Sample(wo, {}, 0, LobeSet::All, mode);
      ASSERT_TRUE(sample);
      EXPECT_LT(LengthSquared(sample->wi - Vector3(-wo.x, -wo.y, wo.z)), Real(1e-12));
      EXPECT_NEAR(LengthSquared(sample->wi), 1, 1e-6);
      EXPECT_NEAR(sample->throughput.r, .3, 1e-6);
      EXPECT_EQ(sample->pdf, 1);
    }
  }
}

// The reflectance of a diffuse lobe is the same under every shading normal and from every side, so
// bumps neither gain nor lose energy. With TransportMode::Importance the same is true of photons.
TEST(Bsdf, OfADiffuseLobeReflectsAllOfItsShareUnderAnyNormal) {
  for (const Real tilt : {Real(0), Real(.3), Real(1), Real(1.4)}) {
    const Bsdf bsdf = Make({&kDiffuse}, TiltedSurface(tilt));
    for (const Vector3& wo : {kOut, kBetween, Vector3(0, 0, -1)}) {
      RandomStream random(1);
      for (int i = 0; i < 300; ++i) {
        const Real x = random.Uniform(), y = random.Uniform();
        for (const TransportMode mode : {TransportMode::Radiance, TransportMode::Importance}) {
          const auto sample = bsdf.Sample(wo, {x, y}, random.Uniform(), LobeSet::All, mode);
          ASSERT_TRUE(sample) << tilt;
          EXPECT_GT(sample->wi.z * wo.z, 0);
          EXPECT_NEAR(sample->throughput.r, .5, 1e-5);
          EXPECT_NEAR(sample->pdf, bsdf.Pdf(wo, sample->wi), 1e-5);
        }
      }
    }
  }
}

TEST(Bsdf, AnInvisibleBoundaryBendsNothingUnderAnyNormal) {
  const SpecularTransmission straight(Spectrum(1), 1, 1, TransportMode::Radiance);
  const Bsdf bsdf = Make({&straight}, TiltedSurface(1));
  for (const Vector3& wo :
       {Vector3(0, 0, 1), Normalize(Vector3(Real(-.99), 0, Real(.14))), Vector3(0, 0, -1)}) {
    const auto sample = bsdf.Sample(wo, {}, 0);
    ASSERT_TRUE(sample);
    EXPECT_LT(LengthSquared(sample->wi + wo), Real(1e-10));
  }
}

TEST(Bsdf, WithoutATangentStillHasAFrame) {
  for (const Vector3& dpdu : {Vector3(0, 0, 0), Vector3(0, 0, 2), Vector3(kInfinity, 0, 0)}) {
    SurfaceInteraction si = FlatSurface();
    si.shading.dpdu = dpdu;
    const auto sample = Make({&kGloss}, si).Sample({0, 0, 1}, {Real(.3), Real(.3)}, 0);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(LengthSquared(sample->wi), 1, 1e-5);
  }
}

TEST(Bsdf, SumsReflectancesUnderTheMask) {
  const Bsdf bsdf = Make({&kDiffuse, &kThrough, &kMirror});
  EXPECT_FLOAT_EQ(float(bsdf.Rho(LobeSet::All).r), 1.05f);
  EXPECT_FLOAT_EQ(float(bsdf.Rho(LobeSet::NonSpecularReflection).r), .5f);
  EXPECT_FLOAT_EQ(float(bsdf.Rho(LobeSet::Transmission).r), .25f);
}

}  // namespace
}  // namespace exphoton
