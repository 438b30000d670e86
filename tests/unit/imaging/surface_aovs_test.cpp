// SPDX-License-Identifier: BSD-2-Clause
// These tests check the AOVs of the first surface: their ranges with every filter, the numbers of
// objects and materials, and depth.
#include <gtest/gtest.h>

#include <cmath>

#include "core/imaging/film/aov_film.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr PixelBounds kSurfacePixel{0, 0, 1, 1};

// The shiny sphere before the bright floor has edges, and rays beside it escape.
class SurfaceAovRanges : public testing::TestWithParam<const char*> {};

// The value of a channel at a pixel.
double At(const Image& image, Point2i pixel, const char* name) {
  const int channel = image.FindChannel(name);
  EXPECT_GE(channel, 0) << name;
  return double(image.At(pixel.x, pixel.y, channel));
}

double LengthOf(const Image& image, Point2i pixel, const std::string& name) {
  return std::hypot(At(image, pixel, (name + ".X").c_str()),
                    At(image, pixel, (name + ".Y").c_str()),
                    At(image, pixel, (name + ".Z").c_str()));
}

// Returns whether a sample of the pixel hit a surface.
bool CheckPixel(const Image& image, Point2i pixel) {
  for (const char* name : {"albedo.R", "albedo.G", "albedo.B", "uv.U", "uv.V"}) {
    EXPECT_GE(At(image, pixel, name), 0) << name;
    EXPECT_LE(At(image, pixel, name), 1) << name;
  }
  const double object = At(image, pixel, "objectId.id");
  EXPECT_TRUE(object == 0 || object == 1 || object == 2) << object;
  EXPECT_EQ(At(image, pixel, "materialId.id"), object);
  const double z = At(image, pixel, "Z");
  EXPECT_NEAR(LengthOf(image, pixel, "N"), z == 0 ? 0 : 1, 1e-6);
  EXPECT_NEAR(LengthOf(image, pixel, "Ng"), z == 0 ? 0 : 1, 1e-6);
  if (z == 0) return false;
  EXPECT_GE(z, 1 - 1e-5);  // the camera is at the origin and looks along z
  EXPECT_LE(z, 9);
  EXPECT_NEAR(z, At(image, pixel, "P.Z"), 1e-5);
  return true;
}

TEST_P(SurfaceAovRanges, AreKeptWithThisFilter) {
  TestRenderOptions options;
  options.aovs = kSurfaceAovs | AovSet{Aov::Variance};
  const std::string text =
      TestHeader("\"directlighting\"", 24, 16, 4) + "PixelFilter " + GetParam() + R"(
WorldBegin LightSource "point" "point from" [0 5 0]
Material "matte" "color Kd" [1 1 1] AttributeBegin Translate 0 0 4
Shape "sphere" "float radius" 1 AttributeEnd
Material "matte" "color Kd" [1 0 .5] Shape "trianglemesh" "integer indices" [0 1 2]
"point P" [-9 -1 1 9 -1 1 0 -1 9] "normal N" [.6 .8 0 -.6 .8 0 0 .8 -.6]
WorldEnd
)";
  const Image image = RenderSceneText(text, options).image;
  int hits = 0, misses = 0, mixed = 0;
  for (int y = 0; y < image.Height(); ++y) {
    for (int x = 0; x < image.Width(); ++x) {
      const bool isHit = CheckPixel(image, {x, y});
      ++(isHit ? hits : misses);
      mixed += isHit && At(image, {x, y}, "albedo.R") < 1;
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(misses, 50);
  EXPECT_GT(mixed, 5);  // edges, where negative weights would leave the range
}

INSTANTIATE_TEST_SUITE_P(Filters, SurfaceAovRanges,
                         testing::Values("\"box\"", "\"triangle\"", "\"gaussian\"", "\"mitchell\"",
                                         "\"sinc\"",
                                         "\"sinc\" \"float xwidth\" 9 \"float ywidth\" 9"));

// An instance has one number, whatever its object has. A shape that is left out takes a number,
// too.
TEST(SurfaceAovs, NumberShapesAndInstancesInTheOrderOfTheFile) {
  TestRenderOptions options;
  options.aovs = {Aov::ObjectId, Aov::MaterialId};
  const Image image = RenderSceneText(TestHeader("\"whitted\"", 4, 1, 16) + R"(WorldBegin
Material "matte" Shape "trianglemesh" "integer indices" [] "point P" []
ObjectBegin "pair" Material "mirror" Shape "disk" "float radius" 1.99
Translate 0 0 1 Shape "disk" "float radius" 1.99 ObjectEnd
Material "glass"
AttributeBegin Translate 2 0 2 ObjectInstance "pair" AttributeEnd
AttributeBegin Translate -2 0 2 Shape "disk" "float radius" 1.99 AttributeEnd
AttributeBegin Translate 6 0 2 ActiveTransform EndTime Translate .01 0 0 ActiveTransform All
Shape "disk" "float radius" 1.99 AttributeEnd
WorldEnd
)",
                                      options)
                          .image;
  const int object = image.FindChannel("objectId.id"),
            material = image.FindChannel("materialId.id");
  // A disk covers three quarters of its pixel.
  EXPECT_EQ(image.At(0, 0, object), 0);
  EXPECT_EQ(image.At(1, 0, object), 3);
  EXPECT_EQ(image.At(2, 0, object), 2);
  EXPECT_EQ(image.At(3, 0, object), 4);
  EXPECT_EQ(image.At(0, 0, material), 0);
  EXPECT_EQ(image.At(1, 0, material), 3);
  EXPECT_EQ(image.At(2, 0, material), 2);
  EXPECT_EQ(image.At(3, 0, material), 3);
}

// Three of four samples of the pixel see the floor.
TEST(AovFilm, HasTheIdOfTheMajority) {
  for (const bool isFirst : {false, true}) {
    Film film(kSurfacePixel, kSurfacePixel);
    AovFilm aovs(kSurfacePixel, {Aov::ObjectId, Aov::Position});
    for (int i = 0; i < 4; ++i) {
      AovSample sample;
      const bool isOther = i == (isFirst ? 0 : 3);
      sample.objectId = isOther ? 0 : 70001;
      sample.isHit = !isOther;
      if (!isOther) sample.p = Point3(0, 0, 2);
      film.AddSample({0, 0}, Spectrum(1), 1, 1);
      aovs.AddSample({0, 0}, sample, Spectrum(1), 1);
    }
    Image image = film.ToImage(true);
    aovs.AppendTo(film, true, &image);
    EXPECT_EQ(image.At(0, 0, image.FindChannel("objectId.id")), 70001);
    EXPECT_EQ(image.At(0, 0, image.FindChannel("P.Z")), 2);  // of the samples that hit
    EXPECT_TRUE(image.exactChannels.contains("objectId.id"));
    EXPECT_TRUE(image.exactChannels.contains("P.Z"));
  }
}

TEST(SurfaceAovs, HaveTheDepthAlongTheViewAxisOrTheDistanceInAllDirections) {
  const auto depth = [](const std::string& camera) {
    TestRenderOptions options;
    options.aovs = {Aov::Depth};
    const std::string text =
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 4\n"
        "PixelFilter \"box\" SurfaceIntegrator \"whitted\" Sampler \"stratified\"\n"
        "Translate 0 0 1 " +
        camera +
        " WorldBegin LightSource \"point\"\n"
        "Shape \"sphere\" \"float radius\" 50\nWorldEnd\n";
    const Image image = RenderSceneText(text, options).image;
    return image.At(4, 2, image.FindChannel("Z"));
  };
  EXPECT_NEAR(depth("Camera \"orthographic\""), 51, .1);
  const double distance = double(depth("Camera \"environment\""));
  EXPECT_GE(distance, 49);
  EXPECT_LE(distance, 51);
  EXPECT_NE(distance, 0);
}

}  // namespace
}  // namespace exphoton
