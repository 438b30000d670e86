// SPDX-License-Identifier: BSD-2-Clause
// These tests count the rays of a setting with several pictures.
#include "core/app/budget/setting_renders.h"

#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton::cli {
namespace {

constexpr int kRays = 8;

// A matte room with a lamp. Nearly all camera samples send the gather rays.
std::string LampInARoom() {
  return TestHeader(
             "\"exphotonmap\" \"integer indirectphotons\" 500 \"integer causticphotons\" 0 "
             "\"integer finalgathersamples\" " +
                 std::to_string(kRays),
             12, 8, 2) +
         "WorldBegin\nMaterial \"matte\"\nReverseOrientation Shape \"sphere\" \"float radius\" 6\n"
         "AreaLightSource \"area\"\nTranslate 0 0 4 Shape \"sphere\" \"float radius\" "
         ".5\nWorldEnd\n";
}

// The edges of the lamp are averaged over several camera rays for each sample.
TEST(SettingRenders, RaysAtEdgesOfLampsAreNoSamples) {
  const LoadedScene scene = LoadSceneText(LampInARoom());
  SettingRequest request;
  request.pictures = {{1, 1}, {1, 2}, {3, 3}};
  const SettingRenders renders = RenderSetting(*scene.setup, request, 1);
  EXPECT_EQ(renders.cameraSamples, 12 * 8 * 2 * 3);
  EXPECT_GT(double(renders.rays.counts[std::size_t(RayKind::Camera)]), 1.2 * renders.cameraSamples);
  EXPECT_NEAR(renders.GatherRaysPerSample(), kRays, .02 * kRays);
}

// More pictures than Corrections keeps groups by default.
TEST(SettingRenders, HaveTheCorrectionOfEachPicture) {
  const LoadedScene scene = LoadSceneText(LampInARoom());
  SettingRequest request;
  request.correctedShare = 1. / 64;
  request.samples = 1;
  for (std::uint64_t seed = 0; seed < Corrections::kMostGroups + 3; ++seed)
    request.pictures.push_back({0, seed});
  EXPECT_EQ(RenderSetting(*scene.setup, request, 1).corrections.size(), request.pictures.size());
}

}  // namespace
}  // namespace exphoton::cli
