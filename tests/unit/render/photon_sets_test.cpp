// SPDX-License-Identifier: BSD-2-Clause
// These tests give passes known signed light, and check the noise of the photons and what follows.
#include "core/render/passes/photons/photon_sets.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/files/byte_archive.h"

namespace exphoton {
namespace {

constexpr PixelBounds kTwoPixels{0, 0, 2, 1};
const std::vector<double> kLevels{.99, .99, .99, .99, .99, .99};  // plus .01 is 1

void AddPass(PhotonNoise* noise, double left, double right, int samples) {
  for (int i = 0; i < samples; ++i) {
    noise->Add({0, 0}, Spectrum(Real(left)), 1);
    noise->Add({1, 0}, Spectrum(Real(right)), 1);
  }
}

TEST(PhotonNoise, IsTheMeanProductOfDifferentPasses) {
  PhotonNoise noise(kTwoPixels);
  AddPass(&noise, .3, -.2, 1);
  noise.EndPass(1);
  EXPECT_FALSE(noise.IsKnown());
  AddPass(&noise, .1, -.4, 1);
  noise.EndPass(1);
  ASSERT_TRUE(noise.IsKnown());
  EXPECT_NEAR(noise.RelativeVariance(kLevels), (.3 * .1 + .2 * .4) / 2, 1e-8);
  // A pass of two samples counts twice in each product.
  AddPass(&noise, .2, .1, 2);
  noise.EndPass(2);
  const double left = .3 * .1 + 2 * .2 * (.3 + .1), right = .2 * .4 - 2 * .1 * (.2 + .4);
  EXPECT_NEAR(noise.RelativeVariance(kLevels), (left + right) / 2 / (1 + 2 + 2), 1e-8);
}

TEST(PhotonNoise, IsNoneWherePassesDisagree) {
  PhotonNoise noise(kTwoPixels);
  for (const double light : {.3, -.3}) {
    AddPass(&noise, light, light, 1);
    noise.EndPass(1);
  }
  EXPECT_EQ(noise.RelativeVariance(kLevels), 0);
}

TEST(PhotonNoise, LeavesOutOtherPixelsAndLightThatIsNotFinite) {
  PhotonNoise noise(kTwoPixels);
  for (int pass = 0; pass < 2; ++pass) {
    AddPass(&noise, .3, .3, 1);
    noise.Add({0, 1}, Spectrum(100), 1);
    noise.Add({1, 0}, Spectrum(std::numeric_limits<Real>::infinity()), 1);
    noise.EndPass(1);
  }
  EXPECT_NEAR(noise.RelativeVariance(kLevels), .09, 1e-7);
}

TEST(PhotonNoise, OfAClearedPixelIsThatOfTheSamplesAfterwards) {
  PhotonNoise noise(kTwoPixels);
  AddPass(&noise, .5, .5, 1);
  noise.EndPass(1);
  AddPass(&noise, 9, .5, 1);
  noise.ClearPixel({0, 0});
  noise.Add({0, 0}, Spectrum(Real(.5)), 1);
  noise.EndPass(1);
  EXPECT_NEAR(noise.RelativeVariance(kLevels), .25, 1e-7);
}

// Renders two passes of light .1 with the noise .01.
PhotonSets SetsWithNoise(double wanted, int nextGroup) {
  PhotonSets sets(kTwoPixels, true);
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_FALSE(sets.IsKnown());
    AddPass(sets.Measurement(), .1, .1, 1);
    sets.EndPass(1);
  }
  EXPECT_TRUE(sets.IsKnown());
  sets.Measure(kLevels);
  sets.Decide(wanted, nextGroup);
  return sets;
}

TEST(PhotonSets, AreOneWhileTheirNoiseIsAQuarterOfWhatIsWanted) {
  const PhotonSets kept = SetsWithNoise(.041, 1);
  EXPECT_NEAR(kept.SharedNoise(), .01, 1e-8);
  for (const int group : {0, 1, 2, 9}) {
    EXPECT_EQ(kept.SetOf(group), 0);
    EXPECT_FALSE(kept.Divides(group));
  }
  PhotonSets divided = SetsWithNoise(.039, 2);
  EXPECT_EQ(divided.SharedNoise(), 0);
  EXPECT_NEAR(divided.FirstNoise(), .01, 1e-8);
  EXPECT_EQ(divided.SetOf(1), 0);
  EXPECT_EQ(divided.SetOf(2), 2);
  EXPECT_EQ(divided.SetOf(3), 3);
  EXPECT_FALSE(divided.Divides(1));
  EXPECT_TRUE(divided.Divides(2));
  EXPECT_FALSE(divided.Divides(3));
  EXPECT_EQ(divided.Measurement(), nullptr);
}

TEST(PhotonSets, AreOneForEachGroupWithoutAMeasurement) {
  PhotonSets sets(kTwoPixels, false);
  EXPECT_EQ(sets.Measurement(), nullptr);
  EXPECT_FALSE(sets.IsKnown());
  for (const int group : {0, 1, 2}) {
    EXPECT_EQ(sets.SetOf(group), group);
    EXPECT_FALSE(sets.Divides(group));
  }
}

TEST(PhotonSets, ComeBackFromAFile) {
  for (const double wanted : {.041, .039}) {
    PhotonSets saved = SetsWithNoise(wanted, 1);
    ByteArchive out;
    saved.Transfer(&out);
    PhotonSets loaded(kTwoPixels, true);
    const std::string bytes = out.Take();
    ByteArchive in(bytes);
    loaded.Transfer(&in);
    EXPECT_EQ(loaded.SharedNoise(), saved.SharedNoise());
    EXPECT_EQ(loaded.SetOf(1), saved.SetOf(1));
    if (!saved.Measurement()) continue;
    for (PhotonSets* sets : {&saved, &loaded}) {
      AddPass(sets->Measurement(), .1, .3, 1);
      sets->EndPass(1);
      sets->Measure(kLevels);
      sets->Decide(1, 1);
    }
    EXPECT_EQ(loaded.SharedNoise(), saved.SharedNoise());
    EXPECT_GT(saved.SharedNoise(), .012);
  }
}

}  // namespace
}  // namespace exphoton
