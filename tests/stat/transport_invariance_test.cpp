// SPDX-License-Identifier: BSD-2-Clause
// These tests check changes that must not alter any bit of a picture: scale and power by powers of
// two, skipped features, threads, tiles and crops. They cover all integrators in a scene with every
// kind of light. Photon integrators appear only in the tests of features, because
// photon_identity_test.cpp covers the rest.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string Grey(double value) {
  const std::string v = Number(value);
  return "[" + v + " " + v + " " + v + "]";
}

// Few photons are enough, because the tests compare bits and noise does not matter.
std::string Integrator(const std::string& name) {
  std::string text = "\"" + name + "\"";
  if (name.find("photon") != std::string::npos)
    text +=
        " \"integer indirectphotons\" 500 \"integer causticphotons\" 200"
        " \"integer directphotons\" 500 \"integer maxphotonpaths\" 20000"
        " \"integer finalgathersamples\" 4";
  if (name == "guidedpath")
    text += " \"integer indirectphotons\" 500 \"integer maxphotonpaths\" 20000";
  if (name == "irradiancecache" || name == "ambientocclusion") text += " \"integer nsamples\" 16";
  return text;
}

struct World {
  double scale = 1, power = 1;
  bool hasGlass = true, hasTexture = true, hasSky = true;
};

std::string Scene(const std::string& integrator, const World& w) {
  const std::string s = Number(w.scale), p2 = Grey(w.power * w.scale * w.scale), p = Grey(w.power);
  std::string text = TestHeader(Integrator(integrator), 20, 16, 4) +
                     "Camera \"perspective\" \"float fov\" 90 \"float hither\" " +
                     Number(w.scale / 1024) + "\nWorldBegin\n";
  text += "Scale " + s + " " + s + " " + s + "\n";
  text += "LightSource \"point\" \"point from\" [1 3 2] \"color I\" " + p2 + "\n";
  text +=
      "LightSource \"spot\" \"point from\" [-1 3 2] \"point to\" [0 -1 5] \"color I\" " + p2 + "\n";
  text += "LightSource \"distant\" \"point from\" [1 2 -1] \"point to\" [0 0 0] \"color L\" " + p +
          "\n";
  if (w.hasSky) text += "LightSource \"infinite\" \"color L\" " + p + "\n";
  text += "AttributeBegin\nAreaLightSource \"area\" \"color L\" " + p +
          "\nTranslate 0 2 4\nShape \"sphere\" \"float radius\" .3\nAttributeEnd\n";
  if (w.hasTexture)
    text +=
        "Texture \"t\" \"color\" \"checkerboard\" \"float uscale\" 8 \"float vscale\" 8\n"
        "Material \"matte\" \"texture Kd\" \"t\"\n";
  text +=
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
      "[-5 -1 1  -5 -1 9  5 -1 9  5 -1 1] \"float uv\" [0 0 0 1 1 1 1 0]\n";
  text +=
      "AttributeBegin\nTranslate -1 0 5\nMaterial \"plastic\"\nShape \"sphere\"\nAttributeEnd\n";
  if (w.hasGlass)
    text += "AttributeBegin\nTranslate 1 0 4\nMaterial \"glass\"\nShape \"sphere\"\nAttributeEnd\n";
  return text + "WorldEnd\n";
}

std::vector<float> Pixels(const std::string& scene, const TestRenderOptions& options = {}) {
  return RenderSceneText(scene, options).image.pixels;
}

class Transport : public testing::TestWithParam<std::string> {};

TEST_P(Transport, SeesTheSameSceneAtEveryScaleOfAPowerOfTwo) {
  const auto one = Pixels(Scene(GetParam(), {}));
  for (const int k : {-20, -10, 10, 20})
    EXPECT_EQ(Pixels(Scene(GetParam(), {.scale = std::ldexp(1.0, k)})), one) << "2^" << k;
}

TEST_P(Transport, ScalesExactlyWithThePowerOfTheLights) {
  const TestRender one = RenderSceneText(Scene(GetParam(), {}));
  const TestRender bright = RenderSceneText(Scene(GetParam(), {.power = 1024}));
  ASSERT_EQ(bright.image.pixels.size(), one.image.pixels.size());
  for (std::size_t i = 0; i < one.image.pixels.size(); ++i) {
    const float factor = i % 4 == 3 ? 1.f : 1024.f;  // alpha does not scale
    ASSERT_EQ(bright.image.pixels[i], one.image.pixels[i] * factor);
  }
}

TEST_P(Transport, GivesTheSameBitsForAnyThreadsTilesAndCrop) {
  const TestRender one = RenderSceneText(Scene(GetParam(), {}));
  TestRenderOptions options;
  options.threads = 3;
  options.tileSize = 5;
  options.tileOrder = TileOrder::Reversed;
  EXPECT_EQ(Pixels(Scene(GetParam(), {}), options), one.image.pixels);
  options.load.pixelBounds = PixelBounds{3, 2, 11, 9};
  const Image crop = RenderSceneText(Scene(GetParam(), {}), options).image;
  for (int y = 0; y < crop.Height(); ++y)
    for (int x = 0; x < crop.Width(); ++x)
      for (int c = 0; c < 4; ++c) ASSERT_EQ(crop.At(x, y, c), one.image.At(x + 3, y + 2, c));
}

INSTANTIATE_TEST_SUITE_P(Integrators, Transport,
                         testing::Values("whitted", "directlighting", "path", "guidedpath",
                                         "bidirectional", "irradiancecache"),
                         [](const auto& info) { return info.param; });

class Features : public testing::TestWithParam<std::string> {};

// Feature culling may turn an effect off only where the effect adds nothing.
TEST_P(Features, ComputedOrSkippedGiveTheSamePictureBitForBit) {
  for (const World& world :
       {World{}, World{.hasGlass = false}, World{.hasTexture = false}, World{.hasSky = false},
        World{.hasGlass = false, .hasTexture = false, .hasSky = false}}) {
    TestRenderOptions all;
    all.load.effects = "all";
    const std::string scene = Scene(GetParam(), world);
    EXPECT_EQ(Pixels(scene, all), Pixels(scene))
        << world.hasGlass << world.hasTexture << world.hasSky;
  }
}

INSTANTIATE_TEST_SUITE_P(Integrators, Features,
                         testing::Values("whitted", "directlighting", "path", "photonmap",
                                         "exphotonmap", "bidirectional", "igi", "irradiancecache",
                                         "ambientocclusion", "debug"),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace exphoton
