// SPDX-License-Identifier: BSD-2-Clause
// These tests check Fresnel's equations, mirrors and refraction at their limits: grazing incidence,
// the critical angle and equal indices. They also check how radiance and photons differ.
#include "core/scattering/lobes/specular.h"
#include "gtest/gtest.h"
#include "tests/support/scattering.h"

namespace exphoton {
namespace {

constexpr Real kIndex = Real(1.5);

std::optional<BxdfSample> Refract(const Vector3& wo, Real index,
                                  TransportMode mode = TransportMode::Importance) {
  return SpecularTransmission(Spectrum(1), 1, index, mode).Sample(wo, {});
}

TEST(FresnelDielectric, IsFourPercentForGlassSeenStraight) {
  EXPECT_NEAR(FresnelDielectric(1, 1, kIndex), .04, 1e-6);
  EXPECT_NEAR(FresnelDielectric(-1, 1, kIndex), .04, 1e-6);
}

TEST(FresnelDielectric, GoesToOneAtGrazingAngles) {
  EXPECT_EQ(FresnelDielectric(0, 1, kIndex), 1);
  EXPECT_GT(FresnelDielectric(Real(1e-6), 1, kIndex), Real(.99999));
}

TEST(FresnelDielectric, IsZeroBetweenEqualIndices) {
  for (Real cosine : {Real(1), Real(.5), Real(1e-3), Real(0), Real(-.5)})
    EXPECT_EQ(FresnelDielectric(cosine, kIndex, kIndex), 0);
}

TEST(FresnelDielectric, IsTheSameFromBothSidesOfOneRay) {
  for (const Vector3& wo : Directions({Real(.9), Real(.5), Real(.1), Real(1e-3)})) {
    const auto sample = Refract(wo, kIndex);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(FresnelDielectric(wo.z, 1, kIndex), FresnelDielectric(sample->wi.z, 1, kIndex),
                1e-3);
  }
}

TEST(FresnelDielectric, IsTotalExactlyWhereNothingIsRefracted) {
  const Real critical = std::sqrt(1 - 1 / (kIndex * kIndex));
  Real cosine = critical;
  for (int i = 0; i < 8; ++i) cosine = NextDown(cosine);
  for (int i = 0; i < 16; ++i, cosine = NextUp(cosine)) {
    const Real f = FresnelDielectric(-cosine, 1, kIndex);
    const Vector3 wo(SafeSqrt(1 - cosine * cosine), 0, -cosine);
    const auto sample = Refract(wo, kIndex);
    EXPECT_EQ(sample.has_value(), f < 1) << i;
    if (sample) {
      EXPECT_TRUE(IsFinite(sample->wi));
      EXPECT_GE(sample->throughput.MinComponent(), 0);
    }
  }
}

TEST(FresnelConductor, MatchesMetalsAndItsEdges) {
  EXPECT_NEAR(FresnelConductor(1, Real(1.1), Real(2.14)), .5105, 1e-3);
  EXPECT_NEAR(FresnelConductor(0, Real(1.1), Real(2.14)), 1, 1e-6);
  EXPECT_EQ(FresnelConductor(0, 0, 0), 1);
  EXPECT_EQ(FresnelConductor(Real(.5), 0, 0), 1);
}

TEST(FresnelConductor, OfAnIndexFromItsReflectanceGivesThatReflectance) {
  for (Real r : {Real(0), Real(.04), Real(.5), Real(.9)})
    EXPECT_NEAR(FresnelConductor(1, EtaFromReflectance(r), 0), r, 1e-5);
  EXPECT_NEAR(FresnelConductor(1, EtaFromReflectance(4), 0), .999, 1e-4);
}

TEST(SpecularReflection, MirrorsOnBothSides) {
  const SpecularReflection mirror(Spectrum(Real(.8)), Fresnel::None());
  for (const Vector3& wo : Directions({1, Real(.3), Real(1e-6), Real(-.3)})) {
    const auto sample = mirror.Sample(wo, {});
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->wi, Vector3(-wo.x, -wo.y, wo.z));
    EXPECT_EQ(sample->throughput, Spectrum(Real(.8)));
    EXPECT_EQ(mirror.f(wo, sample->wi), Spectrum());
    EXPECT_EQ(mirror.Pdf(wo, sample->wi), 0);
  }
  EXPECT_FALSE(mirror.Sample({1, 0, 0}, {}));
}

TEST(SpecularTransmission, ObeysSnell) {
  for (const Vector3& wo : Directions({1, Real(.5), Real(.1), Real(1e-3), Real(-.9)})) {
    const auto sample = Refract(wo, kIndex);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(LengthSquared(sample->wi), 1, 1e-5);
    const Real eta = wo.z > 0 ? 1 / kIndex : kIndex;
    EXPECT_NEAR(sample->wi.x, -eta * wo.x, 1e-6);
    EXPECT_LT(sample->wi.z * wo.z, 0);
  }
}

TEST(SpecularTransmission, BetweenEqualIndicesGoesExactlyThrough) {
  for (const Vector3& wo : Directions({1, Real(.5), Real(1e-4), Real(-.3)})) {
    const auto sample = Refract(wo, 1, TransportMode::Radiance);
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->wi, -wo);
    EXPECT_EQ(sample->throughput, Spectrum(1));
  }
}

TEST(SpecularTransmission, NearlyEqualIndicesAreNearlyInvisible) {
  const Real index = 1 + 2 * kMachineEpsilon;
  for (const Vector3& wo : Directions({1, Real(.5), Real(.01)})) {
    const auto sample = Refract(wo, index);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(LengthSquared(sample->wi + wo), 0, 1e-6);
    EXPECT_NEAR(sample->throughput.r, 1, 1e-5);
  }
}

TEST(SpecularTransmission, ExtremeIndicesStayFinite) {
  for (Real index : {Real(1e-6), Real(1e6)}) {
    for (const Vector3& wo : Directions({1, Real(.5), Real(1e-6), Real(-1), Real(-.5)})) {
      const auto sample = Refract(wo, index, TransportMode::Radiance);
      if (!sample) continue;
      EXPECT_TRUE(IsFinite(sample->wi));
      EXPECT_TRUE(sample->throughput.IsFinite());
    }
  }
}

// Refraction keeps L / eta^2 constant: seen from outside, radiance inside counts 1 / 1.5^2
// of its value.
TEST(SpecularTransmission, ScalesRadianceByTheIndexSquaredAndPhotonsNot) {
  const Real passed = 1 - Real(.04);
  const auto entering = Refract({0, 0, 1}, kIndex, TransportMode::Radiance);
  const auto leaving = Refract({0, 0, -1}, kIndex, TransportMode::Radiance);
  EXPECT_NEAR(entering->throughput.r, passed / (kIndex * kIndex), 1e-6);
  EXPECT_NEAR(leaving->throughput.r, passed * kIndex * kIndex, 1e-5);
  EXPECT_NEAR(Refract({0, 0, 1}, kIndex)->throughput.r, passed, 1e-6);
  EXPECT_NEAR(Refract({0, 0, -1}, kIndex)->throughput.r, passed, 1e-6);
}

TEST(SpecularLobes, OfClearGlassShareAllTheLight) {
  const SpecularReflection reflection(Spectrum(1), Fresnel::Dielectric(1, kIndex));
  const SpecularTransmission transmission(Spectrum(1), 1, kIndex, TransportMode::Importance);
  EXPECT_NEAR(reflection.Rho().r + transmission.Rho().r, 1, 1e-5);
  EXPECT_NEAR(reflection.Rho().r, .0918, 2e-4);  // Walsh 1926: diffuse reflection of glass 1.5
}

}  // namespace
}  // namespace exphoton
