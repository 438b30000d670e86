// SPDX-License-Identifier: BSD-2-Clause
// These tests compare pictures of the photon integrators that must be equal bit for bit: plain
// switches, threads, tiles, crops, scale of the scene, power of the lights, and a second render
// in one process.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Returns a room with a glass ball, a mirror and a coloured wall. All lengths are multiplied by
// `scale` and all radiances by `power`.
std::string Room(const std::string& integrator, double scale, double power, bool scalesRadius) {
  const std::string L = std::to_string(4 * power);
  std::string radius;
  if (scalesRadius) {
    char text[64];
    std::snprintf(text, sizeof text, " \"float maxdist\" [%.9g]", .25 * scale);
    radius = text;
  }
  char scaling[128];
  std::snprintf(scaling, sizeof scaling, "Scale %.9g %.9g %.9g\n", scale, scale, scale);
  char view[256];
  std::snprintf(view, sizeof view,
                "LookAt 0 0 %.9g  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" [80] \"float "
                "hither\" [%.9g]\n",
                -.9375 * scale, scale / 1024);
  return "SurfaceIntegrator " + integrator + radius +
         "\nFilm \"image\" \"integer xresolution\" [24] \"integer yresolution\" [18]\n"
         "PixelFilter \"gaussian\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" [2]\n" +
         view + "WorldBegin\n" + scaling +
         "AttributeBegin\nAreaLightSource \"area\" \"color L\" [" + L + " " + L + " " + L +
         "]\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-.3 .98 -.3  .3 .98 -.3  .3 .98 .3  -.3 .98 .3]\nAttributeEnd\n"
         "Material \"matte\" \"color Kd\" [.75 .7 .6]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 5 6 4 6 7 0 1 5 0 5 4 3 2 6 3 "
         "6 7 1 2 6 1 6 5] \"point P\" [-1 -1 -1  -1 1 -1  1 1 -1  1 -1 -1  -1 -1 1  -1 1 1  1 1 1 "
         " 1 -1 1]\nMaterial \"matte\" \"color Kd\" [.6 .1 .1] \n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" "
         "[-1 -1 -1  1 -1 -1  1 -1 1  -1 -1 1]\n"
         "AttributeBegin\nMaterial \"glass\"\nTranslate .4 -.6 .2\n"
         "Shape \"sphere\" \"float radius\" [.35]\nAttributeEnd\n"
         "AttributeBegin\nMaterial \"mirror\"\nTranslate -.4 -.6 .4\n"
         "Shape \"sphere\" \"float radius\" [.3]\nAttributeEnd\nWorldEnd\n";
}

constexpr const char* kCounts =
    " \"integer indirectphotons\" [3000] \"integer causticphotons\" [500] \"integer nused\" [20] "
    "\"integer finalgathersamples\" [6]";

Image Picture(const std::string& scene, const TestRenderOptions& options = {}) {
  return RenderSceneText(scene, options).image;
}

const std::string kPlain =
    std::string(
        "\"exphotonmap\" \"string lightselection\" \"uniform\" \"string photonroulette\" "
        "\"half\" \"bool radiancephotons\" \"false\" \"string gathersampling\" \"bsdf\" "
        "\"string kernel\" \"constant\" \"float rrthreshold\" 0 \"bool sharedgather\" \"false\" "
        "\"bool guideemission\" \"false\" \"integer edgesamples\" 1 \"bool hidephotons\" "
        "\"false\"") +
    kCounts;

TEST(PhotonIdentity, ExphotonmapWithPlainSwitchesIsPhotonmapBitForBit) {
  const Image plain = Picture(Room(kPlain, 1, 1, true));
  const Image photonmap = Picture(Room(std::string("\"photonmap\"") + kCounts, 1, 1, true));
  EXPECT_EQ(plain.pixels, photonmap.pixels);
  const Image extended = Picture(Room(std::string("\"exphotonmap\"") + kCounts, 1, 1, true));
  EXPECT_NE(extended.pixels, photonmap.pixels);
}

class BothIntegrators : public testing::TestWithParam<const char*> {
 protected:
  std::string Integrator() const { return std::string("\"") + GetParam() + "\"" + kCounts; }
};
INSTANTIATE_TEST_SUITE_P(PhotonIdentity, BothIntegrators,
                         testing::Values("photonmap", "exphotonmap"));

TEST_P(BothIntegrators, GiveTheSameBitsForAnyNumberOfThreadsAndAnyTiles) {
  const std::string scene = Room(Integrator(), 1, 1, false);
  const Image one = Picture(scene);
  for (int threads : {2, 3, 8, 17}) {
    TestRenderOptions options;
    options.threads = threads;
    options.tileSize = threads;
    options.tileOrder = threads % 2 ? TileOrder::Reversed : TileOrder::Scanline;
    EXPECT_EQ(Picture(scene, options).pixels, one.pixels) << threads << " threads";
  }
}

// Paths of "constant" branch, which must not depend on threads either.
TEST(PhotonIdentity, OfConstantPhotonsHoldsForAnyNumberOfThreads) {
  const std::string scene = Room(
      std::string("\"exphotonmap\" \"string photonroulette\" \"constant\"") + kCounts, 1, 1, false);
  const Image one = Picture(scene);
  for (int threads : {2, 5}) {
    TestRenderOptions options;
    options.threads = threads;
    EXPECT_EQ(Picture(scene, options).pixels, one.pixels) << threads << " threads";
  }
}

TEST_P(BothIntegrators, GiveTheSameBitsInACrop) {
  const std::string scene = Room(Integrator(), 1, 1, false);
  const Image whole = Picture(scene);
  TestRenderOptions options;
  options.load.pixelBounds = PixelBounds{5, 3, 17, 15};
  const Image crop = Picture(scene, options);
  ASSERT_EQ(crop.Width(), 12);
  for (int y = 0; y < crop.Height(); ++y)
    for (int x = 0; x < crop.Width(); ++x)
      for (int c = 0; c < 4; ++c) ASSERT_EQ(crop.At(x, y, c), whole.At(x + 5, y + 3, c));
}

TEST_P(BothIntegrators, AreIndependentOfAnEarlierRenderInTheProcess) {
  const std::string scene = Room(Integrator(), 1, 1, false);
  const Image first = Picture(scene);
  EXPECT_EQ(Picture(scene).pixels, first.pixels);
  TestRenderOptions other;
  other.seed = 2;
  EXPECT_NE(Picture(scene, other).pixels, first.pixels);
}

TEST_P(BothIntegrators, SeeTheSameSceneAtEveryScaleOfAPowerOfTwo) {
  for (const bool givesRadius : {true, false}) {
    const Image one = Picture(Room(Integrator(), 1, 1, givesRadius));
    for (int k : {-10, 10}) {
      const Image scaled = Picture(Room(Integrator(), std::ldexp(1.0, k), 1, givesRadius));
      EXPECT_EQ(scaled.pixels, one.pixels) << "scale 2^" << k << ", radius " << givesRadius;
    }
  }
}

TEST_P(BothIntegrators, ScaleExactlyWithThePowerOfTheLights) {
  const Image one = Picture(Room(Integrator(), 1, 1, false));
  Image scaled = Picture(Room(Integrator(), 1, 1024, false));
  ASSERT_EQ(scaled.pixels.size(), one.pixels.size());
  for (int y = 0; y < one.Height(); ++y)
    for (int x = 0; x < one.Width(); ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(scaled.At(x, y, c), 1024 * one.At(x, y, c)) << x << "," << y;
}

}  // namespace
}  // namespace exphoton
