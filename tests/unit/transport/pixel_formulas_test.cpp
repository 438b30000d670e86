// SPDX-License-Identifier: BSD-2-Clause
// These tests render one pixel whose value has a closed form, with each integrator that computes
// it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

double Pixel(const std::string& integrator, const std::string& options, const std::string& world) {
  const std::string camera = "Camera \"perspective\" \"float fov\" .01\n";
  return MeanChannel(
      RenderSceneText(TestHeader(integrator, 1, 1, 16) + camera + options + "WorldBegin\n" + world)
          .image,
      "G");
}

// The shading normal is 37 degrees off the geometric one. The light comes along the latter.
TEST(PixelFormulas, DirectLightHasTheCosineOfTheShadingNormal) {
  const std::string world =
      "LightSource \"distant\" \"point from\" [0 0 -1] \"point to\" [0 0 0] \"color L\" [3 3 3]\n"
      "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 2 1]\n"
      "\"point P\" [-90 -90 4 90 -90 4 0 90 4] \"normal N\" [.6 0 -.8 .6 0 -.8 .6 0 -.8]\n"
      "WorldEnd\n";
  for (const char* integrator : {"\"whitted\"", "\"directlighting\"", "\"path\"", "\"guidedpath\"",
                                 "\"bidirectional\"", "\"igi\"", "\"irradiancecache\""})
    EXPECT_NEAR(Pixel(integrator, "", world), 3 * .5 / 3.14159265 * .8, 1e-5) << integrator;
}

// A long medium, in which a short one lies, in either order of the file.
TEST(PixelFormulas, EmissionOfMediaThatOverlapAddsUpAlongTheWholeRay) {
  const std::string far =
                        "Volume \"homogeneous\" \"color Le\" [.1 .1 .1] \"point p0\" [-9 -9 1] "
                        "\"point p1\" [9 9 5]\n",
                    near =
                        "Volume \"homogeneous\" \"color Le\" [.2 .2 .2] \"point p0\" [-9 -9 2] "
                        "\"point p1\" [9 9 3]\n";
  for (const std::string& media : {far + near, near + far})
    for (const char* integrator : {"\"whitted\"", "\"path\""})
      EXPECT_NEAR(Pixel(integrator, "VolumeIntegrator \"emission\" \"float stepsize\" .01\n",
                        media + "WorldEnd\n"),
                  .1 * 4 + .2 * 1, 2e-3)
          << integrator << media;
}

// The slab behind the camera lets at most exp(-9) of the sky through to the surface. Samples of the
// light and of the BSDF must both see that.
TEST(PixelFormulas, AMediumDimsTheSkyInBothTechniques) {
  const auto world = [](const char* medium) {
    return std::string("LightSource \"infinite\" \"color L\" [1 1 1] \"integer nsamples\" 64\n") +
           medium +
           "Material \"matte\" \"color Kd\" [.5 .5 .5]\nTranslate 0 0 4\nShape \"disk\" \"float "
           "radius\" 50\nWorldEnd\n";
  };
  const char* const kFog =
      "Volume \"homogeneous\" \"color sigma_a\" [9 9 9] \"point p0\" [-1000 -1000 -2] "
      "\"point p1\" [1000 1000 -1]\n";
  for (const char* integrator : {"\"directlighting\"", "\"path\"", "\"whitted\""}) {
    EXPECT_LT(Pixel(integrator, "", world(kFog)), 2e-4) << integrator;
    EXPECT_NEAR(Pixel(integrator, "", world("")), .5, .02) << integrator;
  }
}

}  // namespace
}  // namespace exphoton
