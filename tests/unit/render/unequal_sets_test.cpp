// SPDX-License-Identifier: BSD-2-Clause
// These tests add passes whose noise comes from samples and from photons, and compare the estimated
// noise with the true one.
#include "core/render/passes/photons/unequal_sets.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "core/render/passes/pass_sum.h"

namespace exphoton {
namespace {

constexpr int kWidth = 128;
constexpr PixelBounds kPlane{0, 0, kWidth, kWidth};

// Pixels of the radiance 10. One sample adds the variance `ofSample`, and one set of photons adds
// `ofPhotons` to all samples that use it.
struct NoisyPasses {
  double ofSample, ofPhotons;

  // Returns the estimated and the true noise of relMSE. The first four groups share photons.
  std::pair<double, double> Noise(const std::vector<int>& sizes) const {
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> photons;
    Film picture(kPlane, kPlane);
    PassSum sum(&picture, {{}, 1 << 20});
    double samples = 0, squares = 0, joined = 0;
    for (std::size_t group = 0; group < sizes.size(); ++group) {
      const bool isNew = group == 0 || group >= 4;
      if (group == 4) sum.JoinGroups();
      if (isNew) photons.assign(kWidth * kWidth, 0);
      Film pass(kPlane, kPlane);
      for (std::size_t i = 0; i < photons.size(); ++i) {
        if (isNew) photons[i] = std::sqrt(ofPhotons) * normal(random);
        const double value = 10 + photons[i] + std::sqrt(ofSample / sizes[group]) * normal(random);
        for (int n = 0; n < sizes[group]; ++n)
          pass.AddSample({int(i) % kWidth, int(i) / kWidth}, Spectrum(Real(value)), 1, 1);
      }
      sum.Add(pass, sizes[group], int(group));
      samples += sizes[group];
      group < 4 ? joined += sizes[group] : squares += double(sizes[group]) * sizes[group];
    }
    const double ofSets = (squares + joined * joined) / (samples * samples);
    return {sum.NoiseBetweenGroups(), (ofSample / samples + ofPhotons * ofSets) / 100};
  }
};

TEST(UnequalSets, ShowTheNoiseOfPhotons) {
  const std::vector<int> unequal[] = {{4, 4, 4, 4, 4}, {4, 4, 4, 4, 4, 4, 8}, {2, 2, 2, 2, 8, 16}};
  for (const std::vector<int>& sizes : unequal) {
    for (const NoisyPasses& passes : {NoisyPasses{.3, .03}, NoisyPasses{.3, .003}}) {
      const auto [estimate, noise] = passes.Noise(sizes);
      EXPECT_NEAR(estimate / noise, 1, .06) << sizes.size() << " " << passes.ofPhotons;
    }
  }
}

// Later groups share places, and each has photons of its own.
TEST(UnequalSets, MaySharePlaces) {
  std::vector<int> sizes{2, 2, 2, 2, 8};
  for (int group = 0; group < 9; ++group) sizes.push_back(2);
  const auto [estimate, noise] = NoisyPasses{.3, .1}.Noise(sizes);
  EXPECT_NEAR(estimate / noise, 1, .06);
}

TEST(UnequalSets, ChangeNothingWithoutNoiseOfPhotons) {
  const auto [estimate, noise] = NoisyPasses{.3, 0}.Noise({4, 4, 4, 4, 4, 4, 8});
  EXPECT_NEAR(estimate / noise, 1, .04);
  UnequalSets sets;
  EXPECT_EQ(sets.FactorOn(1), 1);
  sets.Join(0, 8);  // the noise of a sample is not known
  sets.Add(1, 1, 2);
  EXPECT_EQ(sets.FactorOn(1), 1);
}

}  // namespace
}  // namespace exphoton
