// SPDX-License-Identifier: BSD-2-Clause
// These tests check that matrices have homogeneous coordinates. A common factor of all sixteen
// numbers must not change the picture, and a projective matrix must be an error.
#include <gtest/gtest.h>

#include "tests/parser/parse_support.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Numbers(const std::vector<double>& numbers, double factor) {
  std::string text = "[";
  for (const double number : numbers) {
    char one[40];
    std::snprintf(one, sizeof one, " %.17g", number * factor);
    text += one;
  }
  return text + " ]";
}

// Renders quadrics, a mesh, a light and a textured surface, whose matrices are all multiplied
// by the factor.
TestRender RenderTimes(double factor, const std::string& accelerator, const char* directive) {
  const auto place = [&](const std::vector<double>& numbers) {
    return "AttributeBegin " + std::string(directive) + ' ' + Numbers(numbers, factor) + ' ';
  };
  const std::string text =
      "Accelerator \"" + accelerator + "\"\n" + TestHeader("\"directlighting\"", 16, 12, 4) +
      "WorldBegin\n" + place({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 2, -3, 1}) +
      "LightSource \"point\" \"color I\" [400 400 400] AttributeEnd\n" +
      "Texture \"t\" \"color\" \"checkerboard\" \"string mapping\" \"planar\"\n" +
      place({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 4, 1}) +
      "Material \"matte\" \"texture Kd\" \"t\" Shape \"sphere\" AttributeEnd\n" +
      place({.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, .5, 0, 1.2, .5, 4, 1}) +
      "Shape \"cylinder\" AttributeEnd\n" +
      place({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, .5, -1, 4, 1}) +
      "Shape \"disk\" \"float radius\" .7\nShape \"trianglemesh\" \"integer indices\" [0 1 2] "
      "\"point P\" [0 0 .5 1 0 .5 0 1 .5] AttributeEnd\nWorldEnd\n";
  return RenderSceneText(text);
}

double LargestDifference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    largest = std::max(largest, std::abs(double(a.pixels[i]) - double(b.pixels[i])));
  return largest;
}

TEST(Matrix, TimesAFactorDoesNotBlackenOrLoseQuadrics) {
  for (const char* accelerator : {"bruteforce", "bvh", "kdtree"}) {
    const TestRender plain = RenderTimes(1, accelerator, "Transform");
    ASSERT_GT(MeanRadiance(plain.image), .02);
    for (const char* directive : {"Transform", "ConcatTransform"}) {
      for (const double factor : {2., -1., .0625}) {
        EXPECT_EQ(RenderTimes(factor, accelerator, directive).image.pixels, plain.image.pixels)
            << accelerator << " times " << factor;
      }
      // The division by these factors rounds.
      for (const double factor : {1.000001, 3e5, -7e-9}) {
        const TestRender render = RenderTimes(factor, accelerator, directive);
        EXPECT_LT(LargestDifference(render.image, plain.image), 1e-3)
            << accelerator << " times " << factor;
      }
    }
  }
}

TEST(Matrix, ThatIsAProjectionIsAnError) {
  for (const char* directive : {"Transform", "ConcatTransform"}) {
    const BuiltScene built =
        BuildText(InWorld(std::string(directive) + " [1 0 0 0 0 1 0 .5 0 0 1 0 0 0 0 1]"));
    EXPECT_EQ(built.status, 2);
    EXPECT_NE(built.error.find("4:1: error: " + std::string(directive) +
                               ": the matrix is projective: number 8 is not 0"),
              std::string::npos)
        << built.error;
    EXPECT_NE(built.error.find("hint: the matrix is given column by column"), std::string::npos);
  }
  // The first matrix is written row by row, so its translation is read into the last row.
  EXPECT_NE(BuildText(InWorld("Transform [1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1]")).error, "");
  EXPECT_NE(BuildText(InWorld("Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0]")).error, "");
  EXPECT_NE(BuildText(InWorld("Transform [1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 0]")).error, "");
}

TEST(Matrix, WithRoundingInItsLastRowIsAffine) {
  const BuiltScene built =
      BuildText(InWorld("Transform [1 0 0 1e-17 0 1 0 -2e-16 0 0 1 0 5 0 0 1] Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->WorldBounds().Center().x, 5);
}

}  // namespace
}  // namespace exphoton
