// SPDX-License-Identifier: BSD-2-Clause
// These tests check the guide of photon emission: that numbers have the density that is stated,
// that every number keeps its defensive share, and that a guide learns where photons are kept.
#include "integrators/photon/shooting/emission/emission_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/sampling/random.h"
#include "integrators/photon/shooting/emission/emission_training.h"

namespace exphoton {
namespace {

using Numbers = std::array<Real, EmissionNumbers::kDimensions>;

Numbers DrawNumbers(RandomStream* random) {
  Numbers u;
  for (Real& x : u) x = random->Uniform();
  return u;
}

// The box x < 1/4 has half of the mass, and within it y >= 3/4 has nine tenths.
EmissionTree TreeOfThreeBoxes() {
  return EmissionTree(
      {{0, 1, .25, 1}, {1, 3, .75, .5}, {-1, 0, 0, .5}, {-1, 0, 0, .05}, {-1, 0, 0, .45}});
}

TEST(EmissionTree, DrawsNumbersWithTheDensityThatItStates) {
  const EmissionTree tree = TreeOfThreeBoxes();
  RandomStream random(1);
  constexpr int kCount = 100000;
  double inverse = 0, inCorner = 0, inLast = 0;
  for (int i = 0; i < kCount; ++i) {
    Numbers u = DrawNumbers(&random);
    const Numbers before = u;
    const double density = tree.Warp(&u);
    ASSERT_NEAR(density, tree.Density(u), 1e-9 * density);
    for (std::size_t d = 2; d < u.size(); ++d) ASSERT_NEAR(u[d], before[d], 1e-6);
    inverse += 1 / density;
    inCorner += double(u[0]) < .25 && double(u[1]) >= .75;
    inLast += double(u[0]) >= .25;
  }
  // Five standard deviations
  EXPECT_NEAR(inCorner / kCount, .45, .008);
  EXPECT_NEAR(inLast / kCount, .5, .008);
  EXPECT_NEAR(inverse / kCount, 1, .03);
}

TEST(EmissionTree, KeepsNeighboursTogetherWithinABox) {
  const EmissionTree tree = TreeOfThreeBoxes();
  // In the boxes of the lower and the upper child
  for (const Real x : {Real(.1), Real(.7)})
    for (const std::size_t axis : {0, 1}) {
      Numbers a{x, Real(.5), 0, 0, 0, 0}, b = a;
      b[axis] += Real(.01);
      tree.Warp(&a);
      tree.Warp(&b);
      EXPECT_GT(b[axis], a[axis]) << x << " " << axis;
      EXPECT_LT(b[axis] - a[axis], .02) << x << " " << axis;
    }
}

// Photons are kept if the direction depends on the position: |u2 - u0| < 1/32.
std::vector<EmissionSample> Samples(int count, double width) {
  RandomStream random(2);
  std::vector<EmissionSample> samples;
  for (int i = 0; i < count; ++i) {
    const Numbers u = DrawNumbers(&random);
    EmissionSample sample{};
    std::copy(u.begin(), u.end(), sample.u.begin());
    sample.light = i % 2;
    sample.inverseDensity = 2;
    const bool isKept = sample.light == 0 && std::abs(u[2] - u[0]) < width;
    sample.kept[std::size_t(PhotonKind::Caustic)] = isKept ? 3.F : 0.F;
    samples.push_back(sample);
  }
  return samples;
}

constexpr double kDefensive = .25;
const std::array<double, 2> kBase{.5, .5};

EmissionGuide Learned(double width, int count = 40000) {
  return LearnEmission(Samples(count, width), {PhotonKind::Caustic, kBase, kDefensive, 5});
}

TEST(EmissionGuide, LearnsADiagonal) {
  const EmissionGuide guide = Learned(1. / 32);
  RandomStream random(3);
  constexpr int kCount = 20000;
  int kept = 0;
  double weight = 0;
  for (int i = 0; i < kCount; ++i) {
    EmissionNumbers u{random.Uniform(), DrawNumbers(&random)};
    const auto choice = guide.Warp(&u);
    if (choice.light != 0 || !(std::abs(u.u[2] - u.u[0]) < 1. / 32)) continue;
    ++kept;
    weight += 1 / choice.density;
  }
  // Unguided, 1/2 (light) * (1/16 - 1/1024) of the paths are kept.
  EXPECT_GT(kept, 6 * kCount * (1. / 32));
  EXPECT_NEAR(weight / kCount, 1. / 16 - 1. / 1024, .003);
}

TEST(EmissionGuide, SpreadsItsDefensiveShareOverAllNumbersAndLights) {
  const EmissionGuide guide = Learned(1. / 32);
  RandomStream random(4);
  for (int light = 0; light < 2; ++light)
    for (int i = 0; i < 10000; ++i) {
      const double density = guide.Share(light) * guide.Tree(light).Density(DrawNumbers(&random));
      ASSERT_GE(density, kDefensive * kBase[std::size_t(light)] * (1 - 1e-6)) << light;
    }
}

TEST(EmissionGuide, IsEmptyIfNothingWasKept) {
  EXPECT_TRUE(Learned(0).IsEmpty());
  EXPECT_FALSE(Learned(1).IsEmpty());
}

// The last number is not used: it must not be split.
TEST(EmissionGuide, LeavesUnusedNumbersAlone) {
  const EmissionGuide guide = Learned(1. / 32);
  for (const EmissionTree::Node& node : guide.Tree(0).Nodes())
    EXPECT_NE(node.axis, EmissionNumbers::kTime);
}

}  // namespace
}  // namespace exphoton
