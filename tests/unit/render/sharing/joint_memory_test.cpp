// SPDX-License-Identifier: BSD-2-Clause
// These tests check the memory of joint windows, how they join passes, and the AOV of the bias.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/render/sharing/passes/joint_windows.h"

namespace exphoton {
namespace {

constexpr PixelBounds kRoomPicture{0, 0, 40, 30};
constexpr std::int64_t kPlaneSamples = 4;

// Returns whether a picture has room for its first pass in this memory, in bytes a pixel.
bool HasRoomInBytes(const Film& picture, const AovFilm* aovs, double bytesPerPixel) {
  const double pixels = kRoomPicture.Width() * kRoomPicture.Height();
  return JointWindows(picture, aovs, pixels * bytesPerPixel).HasRoomFor(kPlaneSamples);
}

TEST(JointWindows, HaveTheSameRoomInACropAndWithAovs) {
  const PixelBounds crop{3, 3, 5, 5};
  const Film picture(kRoomPicture, kRoomPicture), part(kRoomPicture, crop);
  const AovFilm aovs(crop, {Aov::Direct, Aov::Indirect, Aov::Variance, Aov::SharingBias});
  double bytes = 1;
  while (!HasRoomInBytes(picture, nullptr, bytes)) bytes += 1;
  EXPECT_TRUE(HasRoomInBytes(part, &aovs, bytes));
  EXPECT_FALSE(HasRoomInBytes(part, &aovs, bytes - 1));
}

constexpr PixelBounds kPlane{0, 0, 16, 12};

// Returns the gathers of a pass of a plane.
GatherFragments PassOfPlane(int pass) {
  GatherFragments gathers(kPlane, kPlaneSamples);
  for (int y = 0; y < kPlane.y1; ++y)
    for (int x = 0; x < kPlane.x1; ++x) {
      for (int i = 0; i < int(kPlaneSamples); ++i) {
        const Point2 at{Real(x) + Real(.25) * Real(i), Real(y) + Real(.5)};
        const Spectrum light(Real(1 + (7 * x + 5 * y + 3 * i + pass) % 11));
        const GatherRecord record{
            {at.x / 100, at.y / 100, 0}, {0, 0, 1}, {0, 0, 1}, light, Spectrum(1)};
        gathers.At({x, y}).Add({record}, at, 1, {GatherGroup({x, y}, i), 1});
      }
      gathers.At({x, y}).Finish();
    }
  return gathers;
}

// Returns the light that three passes have after the last fit.
std::vector<double> LightOfPasses(bool fitsEachPass, int threadCount) {
  const Film picture(kPlane, kPlane);
  ThreadPool threads(threadCount);
  JointWindows joint(picture, nullptr, 0x1p30);
  Film light(kPlane, kPlane);
  for (int pass = 0; pass < 3; ++pass) {
    *joint.OfPass() = PassOfPlane(pass);
    joint.Add(kPlaneSamples, pass);
    if (fitsEachPass || pass == 2)
      joint.Fit(&threads, [&](int, const SharingChange& change) { light.Add(change.film); });
  }
  std::vector<double> sums;
  for (std::size_t i = 0; i < light.PixelCount(); ++i) sums.push_back(light.SumsOf(i).g);
  return sums;
}

TEST(JointWindows, AreTheSameWhenSeveralPassesAreJoinedAtOnce) {
  const std::vector<double> once = LightOfPasses(false, 1), each = LightOfPasses(true, 1);
  EXPECT_EQ(once, LightOfPasses(false, 2));
  ASSERT_EQ(once.size(), each.size());
  double most = 0;
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_NEAR(each[i], once[i], 1e-9);
    most = std::max(most, std::abs(once[i]));
  }
  EXPECT_GT(most, .1);
}

TEST(JointWindows, StateTheBiasInItsAov) {
  const Film picture(kPlane, kPlane);
  AovFilm aovs(kPlane, {Aov::SharingBias});
  ThreadPool threads(1);
  JointWindows joint(picture, &aovs, 0x1p30);
  *joint.OfPass() = PassOfPlane(0);
  joint.Add(kPlaneSamples, 0);
  joint.Fit(&threads, [&](int, const SharingChange& change) { aovs.Add(*change.aovs); });
  Image image;
  aovs.AppendTo(picture, false, &image);
  EXPECT_GT(*std::max_element(image.pixels.begin(), image.pixels.end()), .1);
}

}  // namespace
}  // namespace exphoton
