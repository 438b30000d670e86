// SPDX-License-Identifier: BSD-2-Clause
// Light layers of a mirror beside media, in closed form: what a mirror shows is specular light,
// with what media take from it and add to it on both stretches of the way.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const char* const kIntegrators[] = {
    "\"whitted\"", "\"directlighting\"", "\"path\"", "\"bidirectional\"",
    "\"exphotonmap\" \"integer indirectphotons\" 0 \"bool finalgather\" \"false\""};

// The camera looks along +z into a perfect mirror at z = 5, which shows it what lies at negative z.
Image LayersOf(const std::string& integrator, const std::string& world) {
  TestRenderOptions options;
  options.aovs = kLightAovs;
  return RenderSceneText("VolumeIntegrator \"emission\"\n" + TestHeader(integrator, 3, 3, 4) +
                             "WorldBegin\n" + world +
                             "Material \"mirror\" \"color Kr\" [1 1 1] Translate 0 0 5 "
                             "Shape \"disk\" \"float radius\" 50\nWorldEnd\n",
                         options)
      .image;
}
std::string Slab(double z0, double z1, const std::string& parameters) {
  return "Volume \"homogeneous\" \"point p0\" [-90 -90 " + std::to_string(z0) +
         "] \"point p1\" [90 90 " + std::to_string(z1) + "] " + parameters + "\n";
}

void ExpectSpecularOnly(const Image& image, double expected, double tolerance) {
  const int x = 1, y = 1;
  EXPECT_NEAR(double(image.At(x, y, image.FindChannel("G"))), expected, tolerance * expected);
  EXPECT_NEAR(double(image.At(x, y, image.FindChannel("specular.G"))), expected,
              tolerance * expected);
  for (const char* other : {"emission.G", "direct.G", "caustic.G", "indirect.G"})
    EXPECT_EQ(image.At(x, y, image.FindChannel(other)), 0) << other;
}

// A slab of 3 that rays cross twice, at most 20 degrees off the axis in the middle pixel.
TEST(MediaLayers, OfAMirrorBehindFogAreAbsorbedAsThePictureIs) {
  const std::string world = Slab(1, 4, "\"color sigma_a\" [.2 .2 .2]") +
                            "AttributeBegin Material \"matte\" \"color Kd\" [0 0 0] "
                            "AreaLightSource \"area\" \"color L\" [2 2 2] Translate 0 0 -1 "
                            "Shape \"disk\" \"float radius\" 80 AttributeEnd\n";
  for (const char* integrator : kIntegrators) {
    SCOPED_TRACE(integrator);
    const Image image = LayersOf(integrator, world);
    const double picture = double(image.At(1, 1, image.FindChannel("G")));
    EXPECT_LT(picture, 2 * std::exp(-1.2));
    EXPECT_GT(picture, 2 * std::exp(-1.2 / std::cos(.45)));
    ExpectSpecularOnly(image, picture, 1e-5);
  }
}

TEST(MediaLayers, OfGlowingFogInAMirrorAreSpecular) {
  const std::string world = Slab(-4, -1, "\"color Le\" [1 1 1]");
  for (const char* integrator : kIntegrators) {
    SCOPED_TRACE(integrator);
    ExpectSpecularOnly(LayersOf(integrator, world), 3, .15);  // a slant makes the way longer
  }
}

}  // namespace
}  // namespace exphoton
