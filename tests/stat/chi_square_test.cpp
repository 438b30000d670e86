// SPDX-License-Identifier: BSD-2-Clause
// These tests check the chi-square test itself: its tail probabilities must be right, and it must
// refuse wrong densities. The false-alarm rate is 1 % over the three tests of correct samplers.
#include "tests/support/chi_square.h"

#include "core/math/sampling/sampling.h"

namespace exphoton {
namespace {

std::optional<Vector3> SampleCosine(RandomStream& random) {
  const Real x = random.Uniform(), y = random.Uniform();
  return SampleCosineHemisphere({x, y});
}

TEST(ChiSquare, TailAgreesWithTables) {
  EXPECT_NEAR(ChiSquareTail(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(ChiSquareTail(18.30704, 10), 0.05, 1e-6);
  EXPECT_NEAR(ChiSquareTail(61.0983, 100), 0.9993, 2e-4);
  EXPECT_NEAR(ChiSquareTail(149.449, 100), 0.001, 1e-5);
}

TEST(ChiSquare, AcceptsCosineSampling) {
  const auto pdf = [](const Vector3& w) { return double(CosineHemispherePdf(w.z)); };
  EXPECT_TRUE(FitsDensity(TestDirections({}, SampleCosine, pdf), 3));
  EXPECT_TRUE(FitsDensity(TestDirections({{1, 2, 3}, 2}, SampleCosine, pdf), 3));
}

TEST(ChiSquare, AcceptsAUniformSquare) {
  const auto sample = [](RandomStream& random) {
    const Real x = random.Uniform(), y = random.Uniform();
    return std::optional<Point2>({x, y});
  };
  EXPECT_TRUE(FitsDensity(TestPlane({}, sample, [](Point2) { return 1.0; }), 3));
}

TEST(ChiSquare, RefusesAnotherShapeAndAnotherScale) {
  const auto uniform = [](const Vector3& w) { return w.z > 0 ? double(kInv2Pi) : 0; };
  const auto dim = [](const Vector3& w) { return 0.97 * double(CosineHemispherePdf(w.z)); };
  const auto bright = [](const Vector3& w) { return 1.02 * double(CosineHemispherePdf(w.z)); };
  EXPECT_FALSE(FitsDensity(TestDirections({}, SampleCosine, uniform), 1000));
  EXPECT_FALSE(FitsDensity(TestDirections({}, SampleCosine, dim), 1000));
  EXPECT_FALSE(FitsDensity(TestDirections({}, SampleCosine, bright), 1000));
}

}  // namespace
}  // namespace exphoton
