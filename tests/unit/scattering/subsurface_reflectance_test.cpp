// SPDX-License-Identifier: BSD-2-Clause
// These tests check the diffuse reflectance of translucent media.
#include <gtest/gtest.h>

#include "core/scattering/subsurface_reflectance.h"

namespace exphoton {
namespace {

using Rgb = std::array<double, 3>;

// The paper prints the reflectances with two digits. It measured the marble at the index 1.5.
TEST(SubsurfaceReflectance, EqualsThePublishedOne) {
  const struct {
    const char* medium;
    double eta;
    Rgb reflectance;
  } cases[] = {{"Apple", 1.3, {.85, .84, .53}},    {"Chicken2", 1.3, {.32, .16, .10}},
               {"Cream", 1.3, {.98, .90, .73}},    {"Ketchup", 1.3, {.16, .01, .00}},
               {"Marble", 1.5, {.83, .79, .75}},   {"Potato", 1.3, {.77, .62, .21}},
               {"Skimmilk", 1.3, {.81, .81, .69}}, {"Skin1", 1.3, {.44, .22, .13}},
               {"Skin2", 1.3, {.63, .44, .34}},    {"Spectralon", 1.3, {1, 1, 1}},
               {"Wholemilk", 1.3, {.91, .88, .76}}};
  for (const auto& [medium, eta, expected] : cases) {
    const auto coefficients = MeasuredCoefficients(medium);
    ASSERT_TRUE(coefficients) << medium;
    const Rgb reflectance = DipoleReflectance(*coefficients, eta);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(reflectance[c], expected[c], .01) << medium;
  }
  EXPECT_FALSE(MeasuredCoefficients("skin1"));
  EXPECT_TRUE(MeasuredCoefficients(kDefaultMedium));
}

TEST(SubsurfaceReflectance, DependsOnTheRatioOfTheCoefficientsAlone) {
  const Rgb expected = DipoleReflectance({{1, .2, 5}, {3, 4, 1}}, 1.3);
  const Rgb scaled = DipoleReflectance({{1000, 200, 5000}, {3000, 4000, 1000}}, 1.3);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(scaled[c], expected[c], 1e-12);
}

TEST(SubsurfaceReflectance, IsFromNoneToAllOfTheLight) {
  EXPECT_EQ(DipoleReflectance({{0, 0, 1}, {0, 1, 0}}, 1.3), (Rgb{0, 1, 0}));
  for (const double eta : {.1, 1., 3., 100.})
    for (const double share : DipoleReflectance({{-1, .01, 10}, {1, 1, 1}}, eta)) {
      EXPECT_GT(share, 0) << eta;
      EXPECT_LE(share, 1) << eta;
    }
}

}  // namespace
}  // namespace exphoton
