// SPDX-License-Identifier: BSD-2-Clause
// These tests read the texts of certificates.
#include "core/render/certificate/certificate.h"

#include <gtest/gtest.h>

#include "core/imaging/film/film.h"

namespace exphoton {
namespace {

Certificate Made(double squared, double lower, double upper) {
  Certificate certificate;
  certificate.noise = .0016;
  certificate.bias.squared = squared;
  certificate.bias.lower = lower;
  certificate.bias.upper = certificate.bias.smallest = upper;
  certificate.bias.blocks = 1;
  return certificate;
}

std::string AllTexts(const Certificate& certificate) {
  std::string text = ErrorText(certificate);
  for (const std::string& detail : DetailTexts(certificate)) text += "; " + detail;
  return text;
}

TEST(Certificate, HasTheErrorAndItsParts) {
  EXPECT_EQ(ErrorText(Made(.0009, .0001, .0025)),
            "error 5.0 % = noise 4.0 %, bias 3.0 % (1.0 to 5.0 %)");
}

// A certificate of one block printed "error 5711447 %".
TEST(Certificate, SaysInWordsThatItKnowsNothing) {
  const std::string text = AllTexts(Made(3e9, 0, 9e9));
  EXPECT_NE(text.find("error unknown: noise 4.0 %"), std::string::npos) << text;
  EXPECT_NE(text.find("say nothing about the bias"), std::string::npos) << text;
  for (const char* digits : {"000", "477", "948"})
    EXPECT_EQ(text.find(digits), std::string::npos) << text;
  EXPECT_EQ(AllTexts(Made(.5, 0, .9)).find("unknown"), std::string::npos);
}

TEST(Certificate, HasNoDigitsForHugeErrors) {
  const std::string text = ErrorText(Made(3e9, 1e9, 9e9));
  EXPECT_EQ(text, "error over 1000 % = noise 4.0 %, bias over 1000 % (over 1000 to over 1000 %)");
}

// A block that is wider than the picture has the size of the picture.
TEST(Certificate, HasNoBlockThatIsLargerThanThePicture) {
  constexpr int kWidth = 1, kHeight = 5;
  Corrections corrections({0, 0, kWidth, kHeight}, 1);
  for (int group = 0; group < 2; ++group) {
    for (int y = 0; y < kHeight; ++y)
      corrections.Add({0, y}, {1, Spectrum(Real(y % 2 + group)), 1}, 1);
    corrections.EndPass(group, 1);
  }
  const std::vector<double> levels(3 * kWidth * kHeight, 1);
  const std::string text = AllTexts(*Certify(corrections, levels, .5, {}));
  EXPECT_NE(text.find("bias of 1 block of 1 x 5 pixels"), std::string::npos) << text;
}

// Two groups have the correction .1 in all pixels. Half of the pixels have the radiance 1, and
// the others 10. Their true radiance is 1.1 and 10.1.
TEST(Certificate, HasTheBiasRelativeToTheTrueRadiance) {
  constexpr int kWidth = 16, kHeight = 8;
  Corrections corrections({0, 0, kWidth, kHeight}, 1);
  std::vector<double> levels;
  for (int group = 0; group < 2; ++group) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) corrections.Add({x, y}, {1, Spectrum(Real(.2)), 1}, 1);
    corrections.EndPass(group, 2);
  }
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) levels.insert(levels.end(), 3, x < 8 ? 1 : 100);
  const auto certificate = Certify(corrections, levels, .5, {});
  ASSERT_TRUE(certificate);
  EXPECT_NEAR(certificate->bias.squared, .01 / 2 * (1 / (1.21 + .01) + 1 / (102.01 + .01)), 1e-8);
  EXPECT_EQ(certificate->noise, .5);
  EXPECT_EQ(certificate->corrections, 2 * kWidth * kHeight);
}

// The corrections .4 and -.2 have the mean .1, and their product is negative: this is noise.
TEST(Certificate, TakesNoNoiseForAnErrorOfTheRadiance) {
  constexpr int kSize = 8;
  Corrections corrections({0, 0, kSize, kSize}, 1);
  for (int group = 0; group < 2; ++group) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        corrections.Add({x, y}, {1, Spectrum(Real(group == 0 ? .4 : -.2)), 1}, 1);
    corrections.EndPass(group, 1);
  }
  const std::vector<double> levels(std::size_t(3 * kSize * kSize), 1);
  EXPECT_NEAR(Certify(corrections, levels, .5, {})->bias.squared, -.08 / 1.01, 1e-8);
}

// Returns the certificate of a picture of radiance 1 whose corrections have this value without
// noise.
BlockBias BiasOfPicture(double correction) {
  constexpr int kSize = 8;
  Corrections corrections({0, 0, kSize, kSize}, 1);
  for (int group = 0; group < 2; ++group) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        corrections.Add({x, y}, {1, Spectrum(Real(correction)), 1}, 1);
    corrections.EndPass(group, 1);
  }
  const std::vector<double> levels(std::size_t(3 * kSize * kSize), 1);
  return Certify(corrections, levels, .5, {})->bias;
}

// The picture is twice as bright as the truth. Its bias is .5 of its own radiance, and 1 of the
// true one. Corrections that are taken for noise may hide as much again.
TEST(Certificate, HasAnIntervalForAllLevelsOfABrightPicture) {
  const BlockBias bias = BiasOfPicture(-.5);
  const double ofPicture = .25 / 1.01, ofTruth = .25 / .26;
  EXPECT_NEAR(bias.squared, ofTruth, 1e-6);
  EXPECT_NEAR(bias.lower, ofPicture, 1e-6);
  EXPECT_NEAR(bias.upper, ofTruth + (ofTruth - ofPicture), 1e-6);
}

TEST(Certificate, HasAnIntervalForAllLevelsOfADarkPicture) {
  const BlockBias bias = BiasOfPicture(.2);
  const double ofPicture = .04 / 1.01, ofTruth = .04 / 1.45;
  EXPECT_NEAR(bias.squared, ofTruth, 1e-6);
  EXPECT_NEAR(bias.lower, ofTruth - (ofPicture - ofTruth), 1e-6);
  EXPECT_NEAR(bias.upper, ofPicture, 1e-6);
}

// By chance none of few gather rays is corrected. Then nothing is known about their bias.
TEST(Certificate, WithoutCorrectionsDependsOnTheGatherRays) {
  constexpr int kSize = 8;
  const std::vector<double> levels(std::size_t(3 * kSize * kSize), 1);
  const auto certificate = [&](int gatherRays) {
    Corrections corrections({0, 0, kSize, kSize}, 1. / 64);
    for (int group = 0; group < 2; ++group) {
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
          corrections.Add({x, y}, {1. / 64, Spectrum(), 0, gatherRays}, 1);
      corrections.EndPass(group, 1);
    }
    return *Certify(corrections, levels, .01, {});
  };
  EXPECT_EQ(certificate(0).UpperBias(), 0);  // there is nothing to correct
  EXPECT_TRUE(certificate(1).SaysNothing());
  EXPECT_NE(ErrorText(certificate(1)).find("error unknown"), std::string::npos);
  // 200 gathers that meet surfaces would be corrected 200 times on average, and 3.7 of them not at
  // all with the probability 2.5 %.
  EXPECT_NEAR(certificate(100).UpperBias(), 3.689 / 200, 1e-4);
  EXPECT_EQ(certificate(100).LowerBias(), 0);
}

// The corrections of pass i are 1 + i / 100 at each pixel, and their mean is 1.995. The picture has
// the radiance 4, so its true radiance is 5.995.
TEST(Corrections, KeepFewGroupsOfManyPasses) {
  constexpr int kSize = 16, kPasses = 200;
  const std::vector<double> levels(std::size_t(3 * kSize * kSize), 16);
  for (const int joined : {0, 10}) {
    Corrections corrections({0, 0, kSize, kSize}, 1);
    for (int pass = 0; pass < kPasses; ++pass) {
      if (joined > 0 && pass == joined) corrections.JoinGroups();
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x)
          corrections.Add({x, y}, {1, Spectrum(Real(1 + pass / 100.)), 1}, 1);
      corrections.EndPass(pass, 1);
    }
    const auto groups = corrections.Groups();
    EXPECT_LE(groups.size(), std::size_t(Corrections::kMostGroups));
    EXPECT_GE(groups.size(), std::size_t(Corrections::kMostGroups - 10));
    std::int64_t samples = 0;
    double sum = 0;
    for (const auto* group : groups) samples += group->samplesPerPixel, sum += group->sums[0];
    EXPECT_EQ(samples, kPasses);
    EXPECT_NEAR(sum / kPasses, 1.995, 1e-6);
    EXPECT_LE(groups[0]->samplesPerPixel, joined > 0 ? joined : kPasses / 16) << joined;
    const auto certificate = Certify(corrections, levels, .01, {});
    ASSERT_TRUE(certificate);
    EXPECT_NEAR(certificate->bias.squared, 1.995 * 1.995 / (5.995 * 5.995 + .01), .001) << joined;
  }
}

// A state that is made on purpose may lack the group that light belongs to.
TEST(Corrections, TakeLightOfAGroupWithoutSamples) {
  constexpr PixelBounds kCrop{0, 0, 64, 64};
  Corrections corrections(kCrop, 1);
  corrections.KeepSharingApart();
  corrections.EndPass(1, 1);
  corrections.SubtractSharing(Film(kCrop, kCrop), 0);
  EXPECT_EQ(corrections.Groups().size(), 1u);
}

}  // namespace
}  // namespace exphoton
