// SPDX-License-Identifier: BSD-2-Clause
// These tests check photonroulette "constant": every photon has the same luminance, the mean power
// is kept, and photons whose bound was unknown or too low are counted.
#include "integrators/photon/shooting/photon_rejection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/lights/selection/fixed_light_sampler.h"
#include "core/math/sampling/random.h"
#include "core/scene/scene.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// Two point lights of power 4 pi and 12 pi, chosen uniformly.
class TwoLights : public testing::Test {
 protected:
  TwoLights() {
    lights_.push_back(plugins_.MakeLight(R"("point")"));
    lights_.push_back(plugins_.MakeLight(R"("point" "color I" [3 3 3])"));
    for (const auto& light : lights_) light->Prepare({{0, 0, 0}, 1});
    choice_ = std::make_unique<UniformLightSampler>(lights_);
    rejection_ = PhotonRejection(PhotonSources{lights_, *choice_});
  }

  TestPlugins plugins_;
  std::vector<std::unique_ptr<Light>> lights_;
  std::unique_ptr<UniformLightSampler> choice_;
  PhotonRejection rejection_;
};

TEST_F(TwoLights, GiveAUnitOfTheirLargestPowerOverItsProbability) {
  EXPECT_FALSE(PhotonRejection().IsInUse());
  ASSERT_TRUE(rejection_.IsInUse());
  EXPECT_NEAR(double(rejection_.Unit()), 24 * M_PI, 1e-3);
  EXPECT_EQ(rejection_.CopiesOfLight(0), 1);
  EXPECT_EQ(rejection_.CopiesOfLight(1), 1);
}

TEST_F(TwoLights, NeedAsManyCopiesAsTheBoundHasUnits) {
  const Real unit = rejection_.Unit();
  EXPECT_EQ(rejection_.Copies(0), 1);
  EXPECT_EQ(rejection_.Copies(unit), 1);
  EXPECT_EQ(rejection_.Copies(unit * Real(1.000001)), 1);
  EXPECT_EQ(rejection_.Copies(unit * Real(1.01)), 2);
  EXPECT_EQ(rejection_.Copies(unit * 7), 7);
  EXPECT_EQ(rejection_.Copies(std::numeric_limits<Real>::infinity()), 64);
  EXPECT_EQ(rejection_.Copies(std::numeric_limits<Real>::quiet_NaN()), 64);
}

// The mean over copies and uniform numbers of the accepted power must be the power.
TEST_F(TwoLights, AcceptPowerInTheMeanAndAlwaysWithTheSameLuminance) {
  const Real unit = rejection_.Unit();
  for (const Real weight : {Real(.01), Real(.5), Real(1), Real(1.7), Real(2.5)}) {
    const Spectrum power = Spectrum(Real(.5), 1, 3) * (weight * unit / Spectrum(.5, 1, 3).Y());
    for (const int copies : {1, 2, 3}) {
      double sum = 0;
      constexpr int kSteps = 10000;
      for (int i = 0; i < kSteps; ++i) {
        const auto accepted = rejection_.Accept(power, copies, (Real(i) + Real(.5)) / kSteps);
        if (!accepted) continue;
        sum += double(accepted->power.b) * copies / kSteps;
        EXPECT_EQ(accepted->isBeyondBound, weight > Real(copies));
        const double luminance = double(accepted->power.Y());
        EXPECT_NEAR(luminance / double(std::max(unit, weight * unit / Real(copies))), 1, 3e-7);
      }
      EXPECT_NEAR(sum / double(power.b), 1, .02) << weight << " in " << copies;
    }
  }
  EXPECT_FALSE(rejection_.Accept(Spectrum(), 1, 0));
  EXPECT_FALSE(rejection_.Accept(Spectrum(std::numeric_limits<Real>::quiet_NaN()), 1, 0));
}

struct Shots {
  std::vector<Real> luminances;
  std::vector<Spectrum> powers;
  PhotonPassResult result;
};

Shots ShootConstant(const std::string& world, std::int64_t count = 4000) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = count;
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Constant;
  settings.maxPhotonPaths = 1 << 18;
  const LoadedScene loaded = LoadSceneText("WorldBegin\n" + world + "WorldEnd\n");
  Shots shots;
  shots.result = ShootPhotons(*loaded.setup->scene, 1, targets, settings);
  for (PhotonBuffer& buffer : shots.result.buffers) {
    for (std::size_t i = 0; i < buffer.photons.Size(); ++i) {
      shots.powers.push_back(buffer.photons.Records()[i].power.Power());
      shots.luminances.push_back(shots.powers.back().Y());
    }
  }
  return shots;
}

// Returns the distance in units in the last place of the smaller number.
double Ulps(Real a, Real b) {
  const Real low = std::min(a, b);
  return double(std::max(a, b) - low) /
         double(std::nextafter(low, std::numeric_limits<Real>::infinity()) - low);
}

void ExpectEqualLuminances(const Shots& shots) {
  const auto [least, most] = std::minmax_element(shots.luminances.begin(), shots.luminances.end());
  EXPECT_LE(Ulps(*least, *most), 4) << *least << " to " << *most;
  EXPECT_EQ(shots.result.beyondBound, 0);
  EXPECT_EQ(shots.result.divergingPaths, 0);
  EXPECT_EQ(shots.result.droppedPhotons, 0);
}

const std::string kSphere = "ReverseOrientation Shape \"sphere\" \"float radius\" 5\n";
const std::string kLamp = "LightSource \"point\" \"color I\" [3 2 1] \"point from\" [0 0 2]\n";

class ConstantFurnace : public testing::TestWithParam<const char*> {};

TEST_P(ConstantFurnace, HasPhotonsOfEqualLuminance) {
  const Shots shots =
      ShootConstant(kLamp + "Material " + GetParam() + "\n" + kSphere +
                    "AttributeBegin\nReverseOrientation\nAreaLightSource \"area\" \"color L\" [1 "
                    "2 3]\nTranslate 1 1 0\nShape \"sphere\" \"float radius\" .5\nAttributeEnd\n");
  ASSERT_GT(shots.luminances.size(), 4000u);
  ExpectEqualLuminances(shots);
}

INSTANTIATE_TEST_SUITE_P(
    Materials, ConstantFurnace,
    testing::Values(
        R"("matte" "color Kd" [.9 .5 .2])", R"("matte" "color Kd" [.8 .8 .8] "float sigma" 20)",
        R"("plastic" "color Kd" [.6 .3 .1] "color Ks" [.2 .2 .3] "float roughness" .05)",
        R"("substrate" "color Kd" [.6 .3 .1] "color Ks" [.2 .3 .2])", R"("metal")",
        R"("shinymetal" "color Ks" [.5 .4 .3] "color Kr" [.3 .3 .4])",
        R"("translucent" "color Kd" [.5 .5 .5] "color Ks" [.3 .3 .3])",
        R"("uber" "color Kd" [.2 .3 .4] "color Ks" [.2 .2 .2] "color Kr" [.3 .2 .3])",
        R"("bluepaint")", R"("clay")", R"("felt")", R"("primer")", R"("skin")"));

TEST(PhotonRejection, KeepsTheColourOfPhotons) {
  const Shots shots = ShootConstant(kLamp + "Material \"matte\" \"color Kd\" [0 .5 0]\n" + kSphere);
  ExpectEqualLuminances(shots);
  int green = 0;
  for (const Spectrum& power : shots.powers) {
    if (power.r > 0) {
      EXPECT_NEAR(double(power.r / power.g), 1.5, 1e-5);
    } else {
      EXPECT_EQ(power.b, 0);
      ++green;
    }
  }
  EXPECT_GT(green, 1000);
}

// Lights of many kinds together, one much weaker than the others.
TEST(PhotonRejection, GivesThePhotonsOfAllLightsOneLuminance) {
  const Shots shots = ShootConstant(
      kLamp +
      "LightSource \"spot\" \"color I\" [.01 .01 .01]\nLightSource \"goniometric\"\nLightSource "
      "\"projection\"\nAttributeBegin\nAreaLightSource \"area\" \"color L\" [.1 .1 "
      ".1]\nTranslate 1 1 1\nShape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 "
      "1 0 0 0 1 0]\nAttributeEnd\nMaterial \"matte\"\n" +
      kSphere);
  ExpectEqualLuminances(shots);
}

// Media weaken photons on their way. They are then rejected instead.
TEST(PhotonRejection, KeepsTheLuminanceInMedia) {
  const Shots shots =
      ShootConstant(kLamp +
                    "Volume \"homogeneous\" \"point p0\" [-5 -5 -5] \"point p1\" [5 5 5] \"color "
                    "sigma_a\" [.3 .2 .1]\nMaterial \"matte\" \"color Kd\" [.8 .8 .8]\n" +
                    kSphere);
  ExpectEqualLuminances(shots);
}

// Bounds are unknown for measured materials and for lamps that are scaled unevenly, and shading
// normals can exceed them.
TEST(PhotonRejection, CountsPhotonsBeyondTheirBound) {
  const std::string shape =
      "\"integer indices\" [0 1 2 0 2 3] \"point P\" [-9 -9 -1  9 -9 -1  9 9 -1  -9 9 -1] "
      "\"normal N\" [.9 0 .436  .9 0 .436  .9 0 .436  .9 0 .436]\n";
  const Shots tilted = ShootConstant(
      "LightSource \"point\"\nMaterial \"matte\" \"color Kd\" [1 1 1]\nShape "
      "\"trianglemesh\" " +
          shape + "Translate 0 0 3 ReverseOrientation Shape \"disk\" \"float radius\" 9\n",
      2000);
  EXPECT_GT(tilted.result.beyondBound, 0);
  const Shots stretched = ShootConstant(
      "AttributeBegin\nAreaLightSource \"area\"\nScale 1 1 3\nShape \"sphere\"\nAttributeEnd\n"
      "Material \"matte\"\n" +
          kSphere,
      2000);
  EXPECT_GT(stretched.result.beyondBound, 0);
  EXPECT_LT(stretched.result.beyondBound, stretched.result.candidates);
}

// A white room keeps every photon, so only the limit of depth ends paths. A surface that reflects
// twice what it receives doubles the number of photons at each bounce, and the path is given up.
TEST(PhotonRejection, EndsPathsThatNothingAbsorbs) {
  PhotonTargets targets;
  targets[PhotonKind::Indirect] = 1000;
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Constant;
  settings.maxPhotonDepth = 3;
  settings.maxPhotonPaths = 300;
  const auto shoot = [&](const std::string& kd) {
    const LoadedScene loaded =
        LoadSceneText("WorldBegin\n" + kLamp + "Material \"matte\" \"color Kd\" " + kd + "\n" +
                      kSphere + "WorldEnd\n");
    return ShootPhotons(*loaded.setup->scene, 1, targets, settings);
  };
  const PhotonPassResult white = shoot("[1 1 1]");
  EXPECT_NEAR(white.cutPower / white.emittedPower, 1, 1e-3);
  settings.maxPhotonDepth = 1000;
  settings.maxPhotonPaths = 1;
  targets[PhotonKind::Indirect] = 10;
  const PhotonPassResult gaining = shoot("[2 2 2]");
  EXPECT_GT(gaining.divergingPaths, 0);
}

// Within a sphere a ray keeps its angle to the surface. At grazing angles brushed metal reflects up
// to 1.6 times what it receives, and the light there grows without bound. Shooting ends all the
// same, with finite photons.
TEST(PhotonRoulettes, EndInASphereThatGainsLight) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 5000;
  const LoadedScene loaded = LoadSceneText("WorldBegin\n" + kLamp + "Material \"brushedmetal\"\n" +
                                           kSphere + "WorldEnd\n");
  for (const PhotonRoulette roulette : {PhotonRoulette::Luminance, PhotonRoulette::MaxComponent,
                                        PhotonRoulette::Half, PhotonRoulette::Constant}) {
    PhotonSettings settings;
    settings.photonRoulette = roulette;
    PhotonPassResult result = ShootPhotons(*loaded.setup->scene, 1, targets, settings);
    EXPECT_EQ(result.droppedPhotons, 0);
    EXPECT_LT(result.paths, 20000);
    for (PhotonBuffer& buffer : result.buffers) {
      EXPECT_LT(buffer.photons.Size(), 1000000u);
      for (std::size_t i = 0; i < buffer.photons.Size(); ++i)
        ASSERT_TRUE(buffer.photons.Records()[i].power.Power().IsFinite());
    }
  }
}

// The variance of the powers is infinite above an albedo of .71 in a closed room. Photons leave the
// open one.
TEST(PhotonRoulettes, SayWherePowersHaveNoFiniteVariance) {
  const auto says = [](const std::string& parameters, const std::string& albedo,
                       const std::string& shape) {
    return RenderSceneText(
               TestHeader("\"photonmap\" \"integer indirectphotons\" 3000 \"bool finalgather\" "
                          "\"false\" " +
                              parameters,
                          4, 4, 1) +
               "WorldBegin\nLightSource \"point\" \"color I\" [1 2 3]\nMaterial \"matte\" \"color "
               "Kd\" [" +
               albedo + " " + albedo + " " + albedo + "]\nReverseOrientation Shape " + shape +
               "\nWorldEnd\n")
        .Says("the squared power of a photon grows by a factor of ");
  };
  const std::string room = "\"sphere\" \"float radius\" 3";
  EXPECT_TRUE(says("", ".8", room));
  EXPECT_FALSE(says("", ".7", room));
  EXPECT_FALSE(says("", ".8", room + " \"float zmax\" 0"));
  EXPECT_FALSE(says("\"string photonroulette\" \"luminance\"", ".8", room));
  EXPECT_FALSE(says("\"string photonroulette\" \"maxcomponent\"", ".8", room));
}

TEST(PhotonRejection, SaysThatItDoesNotAimPhotons) {
  const auto render = [](const std::string& roulette) {
    return RenderSceneText(
        TestHeader("\"photonmap\" \"integer indirectphotons\" 200 \"string photonaim\" \"on\" "
                   "\"string photonroulette\" \"" +
                       roulette + "\"",
                   4, 4, 1) +
        "WorldBegin\nLightSource \"distant\"\nMaterial \"matte\"\nTranslate 0 0 3\nShape "
        "\"sphere\"\nTranslate 0 0 -3 ReverseOrientation Shape \"sphere\" \"float radius\" "
        "9\nWorldEnd\n");
  };
  EXPECT_TRUE(render("constant").Says("photonaim has no effect"));
  EXPECT_FALSE(render("luminance").Says("photonaim has no effect"));
}

TEST(PhotonRejection, IsReportedInTheStatistics) {
  const std::string scene =
      TestHeader(
          "\"photonmap\" \"integer indirectphotons\" 1000 \"string photonroulette\" "
          "\"constant\"",
          4, 4, 1) +
      FurnaceWorld(1, R"("matte" "color Kd" [.5 .5 .5])");
  const TestRender render = RenderSceneText(scene);
  EXPECT_GE(render.Counter("photons/candidates"), 1000);
  EXPECT_EQ(render.Counter("photons/beyond bound"), 0);
}

}  // namespace
}  // namespace exphoton
