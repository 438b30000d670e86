// SPDX-License-Identifier: BSD-2-Clause
// These tests check that sampling and density of the cone mixture agree at every angle,
// however small.
#include "integrators/photon/gather/cone_mixture.h"

#include <gtest/gtest.h>

#include "core/math/sampling/mis.h"
#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

ConeDirections RandomAxes(std::size_t count, RandomStream* random, Arena* arena) {
  ConeDirections axes(count, arena);
  for (std::size_t i = 0; i < count; ++i)
    axes.Add(SampleUniformSphere({random->Uniform(), random->Uniform()}));
  axes.Finish();
  return axes;
}

TEST(ConeMixture, NeverDrawsADirectionOfZeroDensity) {
  RandomStream random(3);
  Arena arena;
  for (Real degrees : {Real(.001), Real(.01), Real(.1), Real(1), Real(10), Real(45), Real(90)}) {
    const auto axes = RandomAxes(50, &random, &arena);
    const ConeMixture cones(axes, Cone(Radians(degrees)));
    for (int i = 0; i < 2000; ++i) {
      const auto s = cones.Draw(random.Uniform(), {random.Uniform(), random.Uniform()});
      ASSERT_GT(s.pdf, 0);
      ASSERT_TRUE(std::isfinite(s.pdf));
      ASSERT_NEAR(Length(s.w), 1, 1e-5);
    }
  }
}

// The mean of 1 / (density * 4 pi) over drawn directions is the fraction of the sphere that the
// cones cover. Uniform directions give this fraction independently. The tolerance is 4 standard
// errors, so false alarms are below 1e-4.
TEST(ConeMixture, CoversTheSolidAngleThatItsDensityClaims) {
  RandomStream random(5);
  Arena arena;
  for (Real degrees : {Real(5), Real(30), Real(90)}) {
    const auto axes = RandomAxes(5, &random, &arena);
    const ConeMixture cones(axes, Cone(Radians(degrees)));
    const int n = 100000;
    double sum = 0, sum2 = 0, covered = 0;
    for (int i = 0; i < n; ++i) {
      const auto s = cones.Draw(random.Uniform(), {random.Uniform(), random.Uniform()});
      const double x = 1 / (double(s.pdf) * 4 * 3.14159265358979);
      sum += x;
      sum2 += x * x;
      covered += cones.Pdf(SampleUniformSphere({random.Uniform(), random.Uniform()})) > 0;
    }
    const double mean = sum / n, share = covered / n;
    const double error = std::sqrt((sum2 / n - mean * mean + share * (1 - share)) / n);
    EXPECT_NEAR(mean, share, 4 * error) << degrees << " degrees";
  }
}

// In a cone of half-angle a, (1 - cos theta) / (1 - cos a) and the azimuth are uniform.
TEST(ConeMixture, DrawsEvenlyFromACone) {
  RandomStream random(6);
  Arena arena;
  ConeDirections axis(1, &arena);
  axis.Add({0, 0, 1});
  axis.Finish();
  for (const Real degrees : {Real(10), Real(60), Real(90)}) {
    const ConeMixture cones(axis, Cone(Radians(degrees)));
    constexpr int n = 40000;
    double depth = 0, depth2 = 0, x = 0, y = 0;
    for (int i = 0; i < n; ++i) {
      const auto s = cones.Draw(0, {random.Uniform(), random.Uniform()});
      const double t = (1 - double(s.w.z)) / double(OneMinusCos(Radians(degrees)));
      const double across = std::hypot(double(s.w.x), double(s.w.y));
      depth += t / n, depth2 += t * t / n;
      x += double(s.w.x) / across / n, y += double(s.w.y) / across / n;
    }
    // The tolerances are 4 standard errors.
    EXPECT_NEAR(depth, .5, 4 * std::sqrt(1. / 12 / n)) << degrees;
    EXPECT_NEAR(depth2, 1. / 3, 4 * std::sqrt(4. / 45 / n)) << degrees;
    EXPECT_NEAR(x, 0, 4 * std::sqrt(.5 / n)) << degrees;
    EXPECT_NEAR(y, 0, 4 * std::sqrt(.5 / n)) << degrees;
  }
}

TEST(ConeMixture, OfASingleConeHasTheConesDensityDownToTinyAngles) {
  Arena arena;
  ConeDirections axis(1, &arena);
  axis.Add({0, 0, 1});
  axis.Finish();
  for (double degrees : {1e-3, 1e-2, 1.0, 60.0, 90.0}) {
    const ConeMixture cones(axis, Cone(Radians(Real(degrees))));
    const double half = degrees / 360 * 3.14159265358979;
    const double exact = 1 / (4 * 3.14159265358979 * std::sin(half) * std::sin(half));
    EXPECT_NEAR(double(cones.Draw(0, {Real(.5), Real(.5)}).pdf) / exact, 1, 1e-5);
  }
}

TEST(PowerHeuristic, WeightsOfTwoTechniquesAddUpToOne) {
  const Real values[] = {0, Real(1e-45), Real(1e-30), 1, Real(1e30), Real(3e38), kInfinity};
  for (Real p : values)
    for (Real q : values) {
      if (p == 0 && q == 0) continue;
      const Real sum = PowerHeuristic(1, p, 1, q) + PowerHeuristic(1, q, 1, p);
      EXPECT_NEAR(double(sum), 1, 2.4e-7) << p << " " << q;
    }
  EXPECT_EQ(PowerHeuristic(1, 0, 1, 0), 0);
}

// Four samples of a density must count like one sample of four times the density.
TEST(PowerHeuristic, CountsMultiplyDensities) {
  EXPECT_FLOAT_EQ(float(PowerHeuristic(4, Real(.5), 1, 3)), 4.f / 13);
  EXPECT_FLOAT_EQ(float(PowerHeuristic(1, 3, 4, Real(.5))), 9.f / 13);
  EXPECT_FLOAT_EQ(float(PowerHeuristic(8, 1, 2, 1)), 64.f / 68);
}

}  // namespace
}  // namespace exphoton
