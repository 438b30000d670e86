// SPDX-License-Identifier: BSD-2-Clause
// These tests check pictures with shared gathers: their mean, noise, bits, AOVs, and when sharing
// is off.
#include "core/render/sharing/shared_gathers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/render/sharing/sharing_plan.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A room with a mirror and a plastic block under a lamp, seen by `samples` a pixel.
std::string Room(bool isShared, const std::string& more = "", int samples = 2) {
  const std::string integrator =
      std::string(
          R"("exphotonmap" "integer indirectphotons" [ 20000 ] "integer causticphotons" )") +
      R"([ 400 ] "integer finalgathersamples" [ 8 ] "bool sharedgather" [ ")" +
      (isShared ? "true" : "false") + "\" ]";
  return more + TestHeader(integrator, 40, 32, samples) + R"(WorldBegin
    AttributeBegin
      AreaLightSource "area" "color L" [ 20 18 15 ]
      Translate 0 .9 2 Rotate 90 1 0 0 Shape "disk" "float radius" [ .3 ]
    AttributeEnd
    Material "matte" "color Kd" [ .7 .5 0 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point P" [ -1 -1 0  1 -1 0  1 -1 3  -1 -1 3 ]
    Material "plastic" "color Kd" [ .5 .5 .6 ] "color Ks" [ .2 .2 .2 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point P" [ -1 -1 3  1 -1 3  1 1 3  -1 1 3 ]
    Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ]
      "point P" [ -1 1 0  1 1 0  1 1 3  -1 1 3 ]
    AttributeBegin
      Material "mirror" Translate .4 -.6 2.2 Shape "sphere" "float radius" [ .35 ]
    AttributeEnd
    WorldEnd
)";
}

// The same room, large enough for crops and bands that leave gathers beyond their margin out.
constexpr int kLargeWidth = 100, kLargeHeight = 120;
std::string LargeRoom() {
  std::string scene = Room(true);
  const std::string small = "[40] \"integer yresolution\" [32]";
  const std::string large = "[" + std::to_string(kLargeWidth) + "] \"integer yresolution\" [" +
                            std::to_string(kLargeHeight) + "]";
  scene.replace(scene.find(small), small.size(), large);
  return scene;
}

// Returns the mean difference of the channels from the fifth on, which are AOVs.
double Difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (i % a.channels.size() >= 4) sum += double(std::abs(a.pixels[i] - b.pixels[i]));
  return sum / double(a.pixels.size());
}

TestRender RenderRoom(bool isShared, std::uint64_t seed, int samples = 2) {
  TestRenderOptions options;
  options.seed = seed;
  options.aovs = {Aov::Indirect};
  return RenderSceneText(Room(isShared, "", samples), options);
}

TEST(SharedGathers, HaveLessNoiseAndTheSameMean) {
  double apart = 0, shared = 0, means[2] = {};
  for (std::uint64_t seed = 0; seed < 8; seed += 2) {
    const TestRender a[] = {RenderRoom(false, seed), RenderRoom(false, seed + 1)};
    const TestRender b[] = {RenderRoom(true, seed), RenderRoom(true, seed + 1)};
    apart += Difference(a[0].image, a[1].image);
    shared += Difference(b[0].image, b[1].image);
    means[0] += MeanRadiance(a[0].image) + MeanRadiance(a[1].image);
    means[1] += MeanRadiance(b[0].image) + MeanRadiance(b[1].image);
  }
  EXPECT_LT(shared, .75 * apart);
  EXPECT_NEAR(means[1] / means[0], 1, .005);
}

TEST(SharedGathers, DependOnNoThreadTileOrCrop) {
  const std::string scene = LargeRoom();
  TestRenderOptions options;
  options.seed = 3;
  const TestRender whole = RenderSceneText(scene, options);
  options.threads = 3;
  options.tileSize = 5;
  options.tileOrder = TileOrder::Reversed;
  EXPECT_EQ(RenderSceneText(scene, options).image.pixels, whole.image.pixels);
  constexpr PixelBounds kCrop{47, 57, 53, 62};
  ASSERT_GT(kCrop.y0 - SharingMargin(), 0);
  options.load.pixelBounds = kCrop;
  const Image part = RenderSceneText(scene, options).image;
  ASSERT_EQ(part.data, kCrop);
  for (int y = kCrop.y0; y < kCrop.y1; ++y)
    for (int x = kCrop.x0; x < kCrop.x1; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        EXPECT_EQ(part.pixels[std::size_t((y - kCrop.y0) * kCrop.Width() + x - kCrop.x0) * 4 + c],
                  whole.image.pixels[std::size_t(y * kLargeWidth + x) * 4 + c]);
}

TEST(SharedGathers, DoNotDependOnBands) {
  for (const char* filter : {"box", "mitchell"}) {
    std::string scene = LargeRoom();
    scene.replace(scene.find("\"box\""), 5, '"' + std::string(filter) + '"');
    TestRenderOptions options;
    options.seed = 6;
    const TestRender whole = RenderSceneText(scene, options);
    options.sharingMemory = 0;  // bands of 16 rows
    options.threads = 2;
    EXPECT_EQ(RenderSceneText(scene, options).image.pixels, whole.image.pixels) << filter;
  }
}

TEST(SharedGathers, AreTheSameWithAllEffectsOn) {
  TestRenderOptions options;
  options.seed = 4;
  const TestRender whole = RenderSceneText(Room(true), options);
  options.load.effects = "all";
  EXPECT_EQ(RenderSceneText(Room(true), options).image.pixels, whole.image.pixels);
}

TEST(SharedGathers, AreInTheLightAovs) {
  TestRenderOptions options;
  options.aovs = kLightAovs;
  const Image image = RenderSceneText(Room(true), options).image;
  // The light behind the mirror belongs to the specular AOV.
  const double specular = MeanChannel(RenderSceneText(Room(false), options).image, "specular.G");
  EXPECT_NEAR(MeanChannel(image, "specular.G"), specular, .02 * specular);
  const std::size_t channels = image.channels.size();
  ASSERT_EQ(channels, 19u);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (std::size_t aov = 0; aov < 5; ++aov) sum += double(image.pixels[i + 4 + 3 * aov + c]);
      EXPECT_NEAR(sum, double(image.pixels[i + c]), 1e-5 * (1 + sum));
    }
  }
}

TEST(SharedGathers, HaveTheVarianceOfThePixelsThemselves) {
  TestRenderOptions options;
  options.aovs = {Aov::Variance};
  const double shared =
      MeanChannel(RenderSceneText(Room(true, "", 8), options).image, "variance.G");
  const double apart =
      MeanChannel(RenderSceneText(Room(false, "", 8), options).image, "variance.G");
  EXPECT_NEAR(shared / apart, 1, .01);
}

TEST(SharedGathers, KeepAFurnaceExact) {
  const std::string header =
      TestHeader(R"("exphotonmap" "integer indirectphotons" [ 2000 ] "integer finalgathersamples" )"
                 R"([ 4 ] "bool sharedgather" [ "true" ])",
                 16, 16, 2);
  const TestRender render =
      RenderSceneText(header + FurnaceWorld(1, R"("matte" "color Kd" [ .5 .5 .5 ])"));
  EXPECT_NEAR(MeanRadiance(render.image), 2, .02);
}

TEST(SharedGathers, WorkWithOneSampleAPixel) {
  const TestRender render = RenderRoom(true, 5, 1);
  EXPECT_EQ(render.result.nonFiniteSamples, 0);
  EXPECT_GT(render.Counter("render/sharing radius"), 1);
}

TEST(SharingPlan, GivesAReasonWhereSharingIsOff) {
  const auto reasonOf = [](const std::string& text) {
    const LoadedScene scene = LoadSceneText(text);
    const RenderSetup& setup = *scene.setup;
    const SharingPlan plan = PlanSharing(*setup.integrator, *setup.scene, *setup.camera);
    return (plan.isOn ? "on: " : "off: ") + plan.reason;
  };
  EXPECT_EQ(reasonOf(Room(true)), "on: between neighbouring pixels on one surface");
  EXPECT_EQ(reasonOf(Room(false)), "off: ");
  std::string lens = Room(true);
  lens.insert(lens.find("\"float fov\""),
              "\"float lensradius\" [ .1 ] \"float focaldistance\" [ 2 ] ");
  EXPECT_EQ(reasonOf(lens), "off: the camera has a lens");
  EXPECT_TRUE(RenderSceneText(lens).Says("gathers are not shared: the camera has a lens"));
  const std::string moves =
      "TransformTimes 0 1 ActiveTransform EndTime Translate .1 0 0 ActiveTransform All\n";
  std::string camera = Room(true, moves);
  EXPECT_EQ(reasonOf(camera), "off: the camera moves");
  std::string shape = Room(true);
  shape.insert(shape.find("Shape \"sphere\""),
               "ActiveTransform EndTime Translate .1 0 0 ActiveTransform All ");
  shape.insert(shape.find("WorldBegin"), "TransformTimes 0 1\n");
  EXPECT_EQ(reasonOf(shape), "off: a shape moves");
}

}  // namespace
}  // namespace exphoton
