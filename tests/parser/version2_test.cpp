// SPDX-License-Identifier: BSD-2-Clause
// These tests check parameters of version 2: halffov, gamma and scale of images, the samplers
// adaptive and random, and the defaults of igi.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/imaging/files/png.h"
#include "core/imaging/files/srgb.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

Vector3 CornerRay(const std::string& camera) {
  const BuiltScene built = BuildText("Camera \"perspective\" " + camera + "\n" + InWorld(""));
  EXPECT_EQ(built.error, "");
  CameraSample sample;
  sample.film = Point2(0, 0);
  return built.setups.at(0)->camera->GenerateRay(sample, false).d;
}

TEST(Version2, HasHalfOfTheFieldOfView) {
  EXPECT_EQ(CornerRay("\"float halffov\" 20"), CornerRay("\"float fov\" 40"));
  EXPECT_EQ(CornerRay("\"float fov\" 70 \"float halffov\" 20"), CornerRay("\"float fov\" 40"));
  const BuiltScene wide = BuildText("Camera \"perspective\" \"float halffov\" 90\n" + InWorld(""));
  EXPECT_NE(wide.error.find("parameter \"halffov\" of camera \"perspective\" must be above 0 and "
                            "below 90, not 90"),
            std::string::npos)
      << wide.error;
}

TEST(Version2, HasASamplerThatTakesItsLargestNumberOfSamples) {
  const BuiltScene built = BuildText(
      "Sampler \"adaptive\" \"integer minsamples\" 4 \"integer maxsamples\" 20 \"string method\" "
      "\"shapeid\"\n" +
      InWorld(""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups.at(0)->sampler->SamplesPerPixel(), 32);
  EXPECT_NE(built.Messages().find("scene.pbrt:1:1: warning: sampler \"adaptive\" takes the largest "
                                  "number of samples, 32, in every pixel\n"),
            std::string::npos)
      << built.Messages();
  const BuiltScene plain = BuildText("Sampler \"adaptive\"\n" + InWorld(""));
  EXPECT_EQ(plain.setups.at(0)->sampler->SamplesPerPixel(), 32);
  const BuiltScene least = BuildText(
      "Sampler \"adaptive\" \"integer minsamples\" 60 \"integer maxsamples\" 20\n" + InWorld(""));
  EXPECT_EQ(least.setups.at(0)->sampler->SamplesPerPixel(), 32);  // minsamples has no effect
  const BuiltScene random =
      BuildText("Sampler \"random\" \"integer pixelsamples\" 7\n" + InWorld(""));
  EXPECT_EQ(random.setups.at(0)->sampler->SamplesPerPixel(), 7);
}

// Returns the radiance that a sphere textured with a picture of one colour reflects.
Real TexelOf(const std::string& parameters, Dialect dialect) {
  const std::string path = testing::TempDir() + "exphoton-texel.png";
  Image image(2, 2, {"R", "G", "B"});
  for (float& value : image.pixels) value = float(DecodeSrgb(100 / 255.));
  WritePng(path, image);
  LoadOptions options;
  options.dialect = dialect;
  const BuiltScene built = BuildText(
      InWorld("Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"" + path + "\" " +
              parameters + "\nMaterial \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\""),
      options);
  EXPECT_EQ(built.error, "");
  Arena arena;
  Ray ray;
  ray.o = Point3(0, 0, 3);
  ray.d = Vector3(Real(.1), Real(.05), -1);
  auto hit = built.setups.at(0)->scene->Intersect(ray);
  EXPECT_TRUE(hit.has_value());
  return hit->material->Evaluate(&*hit, TransportMode::Radiance, &arena).Rho(LobeSet::All).r;
}

TEST(Version2, HasGammaAndScaleOfImages) {
  const double stored = 100 / 255.;
  EXPECT_NEAR(TexelOf("", Dialect::V1), DecodeSrgb(stored), 1e-4);
  EXPECT_NEAR(TexelOf("\"float scale\" 2", Dialect::V1), 2 * DecodeSrgb(stored), 1e-4);
  EXPECT_NEAR(TexelOf("\"float gamma\" 1", Dialect::V1), stored, 1e-4);
  EXPECT_NEAR(TexelOf("", Dialect::V2), stored, 1e-4);
  EXPECT_NEAR(TexelOf("\"float gamma\" 2.2", Dialect::V2), std::pow(stored, 2.2), 1e-4);
  EXPECT_NEAR(TexelOf("\"float gamma\" 2.2 \"float scale\" .5", Dialect::V2),
              std::pow(stored / 2, 2.2), 1e-4);
}

}  // namespace
}  // namespace exphoton
