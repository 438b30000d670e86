// SPDX-License-Identifier: BSD-2-Clause
// These tests check light "infinite" with an environment map, which each test writes to a file: its
// orientation, its power, and texels that are not valid radiance.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/imaging/files/exr.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::optional<LightLiSample> Direct(const Light& light, const Point3& p) {
  return light.SampleDirect({p, {}, {0, 1, 0}}, {Real(.3), Real(.6)}, Real(.5));
}

class EnvironmentMap : public testing::Test {
 protected:
  std::string Write(int width, int height, const std::vector<float>& grey) {
    Image image(width, height, {"R", "G", "B"});
    for (int i = 0; i < width * height; ++i)
      for (int c = 0; c < 3; ++c) image.At(i % width, i / width, c) = grey[std::size_t(i)];
    const std::string path = testing::TempDir() + "exphoton_environment_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() + ".exr";
    WriteExr(path, image, false);
    return "\"infinite\" \"string mapname\" \"" + path + "\"";
  }
  TestPlugins plugins_;
};

TEST_F(EnvironmentMap, OfOneTexelEqualsAUniformSkyBitForBit) {
  const auto map = plugins_.MakeLight(Write(1, 1, {1.f}));
  const auto sky = plugins_.MakeLight("\"infinite\"");
  for (Light* light : {map.get(), sky.get()}) light->Prepare({{0, 0, 0}, 2});
  EXPECT_EQ(map->Power(), sky->Power());
  const auto a = Direct(*map, {1, 2, 3}), b = Direct(*sky, {1, 2, 3});
  EXPECT_EQ(a->wi, b->wi);
  EXPECT_EQ(a->Li, b->Li);
  EXPECT_EQ(a->pdf, b->pdf);
}

TEST_F(EnvironmentMap, WithTexelsThatAreNoRadianceWarnsOnceAndStaysFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto light = plugins_.MakeLight(Write(4, 2, {nan, inf, -1.f, 1.f, 0.f, 0.f, 2.f, 0.f}));
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
  light->Prepare({{0, 0, 0}, 1});
  EXPECT_TRUE(light->Power().IsFinite());
  EXPECT_GT(light->Power().g, 0);
  const auto sample = Direct(*light, {0, 0, 0});
  ASSERT_TRUE(sample);
  EXPECT_TRUE(sample->Li.IsFinite());
}

TEST_F(EnvironmentMap, ThatIsBlackIsOffWithAWarning) {
  const auto light = plugins_.MakeLight(Write(3, 2, std::vector<float>(6, 0.f)));
  EXPECT_TRUE(light->IsProvablyBlack());
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
}

TEST_F(EnvironmentMap, HasItsTopRowAtPlusZAndTurnsAboutZ) {
  // The map has 4 columns of a quarter turn. Its top row is 1..4 and its bottom row is 5..8.
  const auto light = plugins_.MakeLight(Write(4, 2, {1, 2, 3, 4, 5, 6, 7, 8}));
  // The directions are texel centres: azimuths of 45, 135 and 315 degrees, 45 degrees above and
  // below the horizon.
  const Real h = std::sqrt(Real(.5)), q = Real(.5);
  EXPECT_NEAR(double(light->Le({q, q, h}).g), 1, 1e-5);
  EXPECT_NEAR(double(light->Le({-q, q, h}).g), 2, 1e-5);
  EXPECT_NEAR(double(light->Le({q, -q, -h}).g), 8, 1e-5);
}

// Beyond a pole the map continues half a turn away, so there is no seam at the pole.
TEST_F(EnvironmentMap, IsTheMeanOfOppositeColumnsAtThePoles) {
  const auto light = plugins_.MakeLight(Write(4, 2, {1, 2, 3, 4, 5, 6, 8, 9}));
  const Real e = Real(1e-4);
  EXPECT_NEAR(double(light->Le({e, e, 1}).g), (1 + 3) / 2., 1e-3);
  EXPECT_NEAR(double(light->Le({-e, e, 1}).g), (2 + 4) / 2., 1e-3);
  EXPECT_NEAR(double(light->Le({e, e, -1}).g), (5 + 8) / 2., 1e-3);
}

TEST_F(EnvironmentMap, PowerIsItsIntegralTimesTheDisk) {
  const auto light = plugins_.MakeLight(Write(8, 4, [] {
    std::vector<float> grey;
    for (int i = 0; i < 32; ++i) grey.push_back(float(i % 5));
    return grey;
  }()));
  light->Prepare({{0, 0, 0}, 1});
  // The midpoint rule is applied in (cos theta, phi).
  double integral = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Real z = Real(-1 + (i + .5) * 2 / kSteps), phi = Real((j + .5) * 2 * M_PI / kSteps);
      integral += double(light->Le(SphericalDirection(SafeSqrt(1 - z * z), z, phi)).g);
    }
  }
  integral *= 4 * M_PI / kSteps / kSteps;
  // Power weights the mean of each cell by the cell's solid angle. This estimate is accurate to a
  // few per cent for coarse maps.
  EXPECT_NEAR(double(light->Power().g), M_PI * integral, 0.05 * M_PI * integral);
}

TEST_F(EnvironmentMap, IsSampledTheSameUnderEveryScale) {
  const std::string text = Write(4, 2, {1, 2, 3, 4, 5, 6, 7, 8});
  const auto plain = plugins_.MakeLight(text);
  plain->Prepare({{0, 0, 0}, 1});
  const auto expected = Direct(*plain, {0, 0, 0});
  ASSERT_TRUE(expected);
  for (const double scale : {1e14, 1e-16}) {
    const auto light = plugins_.MakeLight(text, *Transform::Scale(scale, scale, scale));
    light->Prepare({{0, 0, 0}, 1});
    const auto sample = Direct(*light, {0, 0, 0});
    ASSERT_TRUE(sample) << scale;
    EXPECT_LT(LengthSquared(sample->wi - expected->wi), Real(1e-12)) << scale;
    EXPECT_NEAR(double(sample->pdf / expected->pdf), 1, 1e-5) << scale;
    EXPECT_TRUE(light->SampleEmission({}, {Real(.3), Real(.6)}, 0, 0)) << scale;
  }
}

TEST_F(EnvironmentMap, WithOneValueThatIsNoRadianceWarns) {
  Image image(2, 1, {"R", "G", "B"});
  image.At(0, 0, 1) = -1;
  image.At(1, 0, 2) = 1;
  const std::string path = testing::TempDir() + "exphoton_one_bad_value.exr";
  WriteExr(path, image, false);
  plugins_.MakeLight("\"infinite\" \"string mapname\" \"" + path + "\"");
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
}

// A map and a factor may leave no channel together.
TEST_F(EnvironmentMap, ThatSharesNoColourWithItsFactorIsBlack) {
  Image image(2, 1, {"R", "G", "B"});
  image.At(0, 0, 0) = 1;
  image.At(1, 0, 0) = 2;
  const std::string path = testing::TempDir() + "exphoton_red_sky.exr";
  WriteExr(path, image, false);
  const std::string text = "\"infinite\" \"string mapname\" \"" + path + "\" \"color L\" ";
  EXPECT_TRUE(plugins_.MakeLight(text + "[0 1 1]")->IsProvablyBlack());
  EXPECT_FALSE(plugins_.MakeLight(text + "[1 0 0]")->IsProvablyBlack());
}

}  // namespace
}  // namespace exphoton
