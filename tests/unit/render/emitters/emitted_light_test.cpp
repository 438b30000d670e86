// SPDX-License-Identifier: BSD-2-Clause
// These tests follow single camera rays to lamps, and check which pixels look for lamps, and where.
#include "core/render/emitters/emitted_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "core/render/emitters/moving_emitters.h"
#include "core/render/emitters/still_emitters.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr int kLampWidth = 20, kLampHeight = 12;

class EmittedLightTest : public testing::Test {
 protected:
  // `view` precedes the camera.
  void Load(const std::string& world, const std::string& view = "") {
    loaded_ = LoadSceneText(view + TestHeader("\"path\"", kLampWidth, kLampHeight, 1) +
                            "WorldBegin\n" + world + "WorldEnd\n");
    film_.emplace(loaded_.setup->film.Full(), loaded_.setup->crop);
    emitters_.emplace(FilmView{*Setup().scene, *Setup().camera, *Setup().filter, *film_}, 3);
  }
  const RenderSetup& Setup() const { return *loaded_.setup; }
  // Returns the light along the axis of the camera.
  EmittedLight Along() {
    const LiContext sample{*Setup().scene, samples_, arena_, rays_, 7};
    CameraSample center;
    center.film = {Real(kLampWidth) / 2, Real(kLampHeight) / 2};
    center.lens = Point2(Real(.5), Real(.5));
    return emitters_->AllAlong(Setup().camera->GenerateRay(center, false), sample, &counted_);
  }

  LoadedScene loaded_;
  std::optional<Film> film_;
  std::optional<StillEmitters> emitters_;
  CameraSamples samples_{SampleLayout()};
  Arena arena_;
  RayCounters rays_, counted_;
};

// Fog with an optical depth of .5 per unit begins at z = 1.
const char* const kFog =
    "Volume \"homogeneous\" \"point p0\" [-9 -9 1] \"point p1\" [9 9 9] \"color sigma_a\" [.5 .5 "
    ".5] \"color sigma_s\" [0 0 0]\n";
// The lamp is a disk at z = 3 that faces the camera.
const char* const kFacingLamp =
    "AttributeBegin AreaLightSource \"area\" \"color L\" [8 4 2] Translate 0 0 3 "
    "ReverseOrientation Shape \"disk\" \"float radius\" .5 AttributeEnd\n";
// This mirror shows the lamp behind the camera.
const char* const kFacingMirror =
    "AttributeBegin AreaLightSource \"area\" \"color L\" [8 4 2] Translate 0 0 -1 Shape \"disk\" "
    "\"float radius\" .5 AttributeEnd\nAttributeBegin Material \"mirror\" \"color Kr\" [.5 .5 .5] "
    "Translate 0 0 3 Shape \"disk\" \"float radius\" 4 AttributeEnd\n";

TEST_F(EmittedLightTest, OfTheFirstSurfacePassesTheMedium) {
  Load(std::string(kFog) + kFacingLamp);
  const EmittedLight light = Along();
  EXPECT_NEAR(double(light.first.r), 8 * std::exp(-1.), 1e-5);
  EXPECT_NEAR(double(light.first.b), 2 * std::exp(-1.), 1e-5);
  EXPECT_TRUE(light.specular.IsBlack());
  EXPECT_TRUE(light.isNear);
}

TEST_F(EmittedLightTest, OverAMirrorIsSpecularAndCountsItsRays) {
  Load(kFacingMirror);
  for (int tree = 1; tree <= 3; ++tree) {
    const EmittedLight light = Along();
    EXPECT_TRUE(light.first.IsBlack());
    EXPECT_NEAR(double(light.specular.r), 4, 1e-5);
    EXPECT_EQ(counted_.counts[std::size_t(RayKind::Camera)], std::uint64_t(tree));
    EXPECT_EQ(counted_.counts[std::size_t(RayKind::Specular)], std::uint64_t(tree));
  }
  EXPECT_EQ(rays_.Total(), 0u);
}

TEST_F(EmittedLightTest, TreesOfFewRaysHaveManyPlaces) {
  const int expected[][2] = {{0, 1}, {1, 16}, {2, 16}, {3, 8}, {8, 4}, {16, 2}, {17, 1}, {900, 1}};
  for (const auto& [rays, places] : expected) {
    Load(kFacingMirror);  // forgets the rays of the pixels
    EXPECT_EQ(emitters_->PlacesForReflections({5, 6}, [n = rays](Point2i) { return n; }), places)
        << rays;
  }
}

// A filter of one pixel reaches the next pixels.
TEST_F(EmittedLightTest, TheNextPixelsAreAskedForReflections) {
  Load(kFacingMirror);
  std::set<std::pair<int, int>> asked;
  const auto ask = [&](Point2i pixel) { return asked.insert({pixel.x, pixel.y}), 0; };
  emitters_->PlacesForReflections({5, 6}, ask);
  EXPECT_EQ(asked.size(), 9u);
  EXPECT_TRUE(asked.contains({4, 5}) && asked.contains({6, 7}));
  asked.clear();
  emitters_->PlacesForReflections({6, 6}, ask);  // six of its nine pixels are known
  EXPECT_EQ(asked.size(), 3u);
}

TEST_F(EmittedLightTest, ALampThatMovesHasNoPlaces) {
  const Point2i pixel{kLampWidth / 2, kLampHeight / 2};
  const std::string before = "AttributeBegin\nAreaLightSource \"area\"\nTranslate 0 0 3\n",
                    moves = "ActiveTransform EndTime Translate .5 0 0 ActiveTransform All\n";
  for (const std::string radius : {".5", ".1"}) {
    const std::string lamp = "Shape \"sphere\" \"float radius\" " + radius + "\nAttributeEnd\n";
    Load(before + lamp);
    EXPECT_NE(emitters_->PlacesIn(pixel) > 1, !emitters_->Tiny().In(pixel).empty()) << radius;
    Load(before + moves + lamp);
    EXPECT_EQ(emitters_->PlacesIn(pixel), 1);
    EXPECT_TRUE(emitters_->Tiny().In(pixel).empty());
  }
}

// In the camera's space, a thin rod begins at (3, 0, -1) and ends at (-1, 0, 1). It passes the
// plane of the camera at (1, 0, 0), so it covers the picture from pixel 4 to the right edge.
TEST_F(EmittedLightTest, ALampThatReachesBehindTheCameraHasPlaces) {
  Load(
      "AreaLightSource \"area\"\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point "
      "P\" "
      "[-3.13 -.01 .447  1.34 -.01 .447  1.34 .01 .447  -3.13 .01 .447]\n",
      "LookAt 0 0 0 .447 0 .894 0 1 0\n");
  for (const int x : {5, kLampWidth / 2, kLampWidth - 2})
    EXPECT_GT(emitters_->PlacesIn({x, kLampHeight / 2}), 1) << x;
  EXPECT_EQ(emitters_->PlacesIn({1, kLampHeight / 2}), 1);
}

// Places on a diagonal would have equally many rows and columns.
TEST_F(EmittedLightTest, PlacesAreNotOnADiagonal) {
  std::set<int> diagonals;
  for (int i = 0; i < 16; ++i) {
    const Point2 place = StillEmitters::Place({0, 0}, i, 16);
    diagonals.insert(int(16 * place.x) - int(16 * place.y));
  }
  EXPECT_GT(diagonals.size(), 4u);
}

TEST(LazyPixelBytes, OfEachPixelAreComputedOnce) {
  LazyPixelBytes bytes({-2, 3, 9, 7});
  int calls = 0;
  const auto compute = [&](Point2i pixel) { return ++calls, 10 * (pixel.x + 2) + pixel.y; };
  for (int turn = 0; turn < 2; ++turn)
    for (int y = 3; y < 7; ++y)
      for (int x = -2; x < 9; ++x) EXPECT_EQ(bytes.At({x, y}, compute), 10 * (x + 2) + y);
  EXPECT_EQ(calls, 44);
}

TEST(LazyPixelBytes, LimitLargeValues) {
  LazyPixelBytes bytes({0, 0, 2, 1});
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(bytes.At({0, 0}, [](Point2i) { return 255; }), LazyPixelBytes::kMost);
    EXPECT_EQ(bytes.At({1, 0}, [](Point2i) { return 1000; }), LazyPixelBytes::kMost);
  }
}

// A time at which the rays are far from the lamps does not count. The own time always counts.
TEST(EmissionMean, IsOfTheTimesNearTheEmitters) {
  EmittedLight near{Spectrum(6), Spectrum(3), true}, far{Spectrum(0), Spectrum(0), false};
  EmissionMean mean(near);
  mean.Add(far);
  mean.Add({Spectrum(0), Spectrum(0), true});
  EXPECT_EQ(mean.First(), Spectrum(3));
  EXPECT_EQ(mean.Specular(), Spectrum(Real(1.5)));
}

}  // namespace
}  // namespace exphoton
