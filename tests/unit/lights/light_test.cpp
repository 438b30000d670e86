// SPDX-License-Identifier: BSD-2-Clause
// These tests check single lights: radiometric units, closed forms of their power, and limits of
// their parameters. environment_map_test.cpp checks environment maps.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr Real kRelative = Real(2e-6);  // a few rounding errors

void ExpectNear(Real actual, Real expected) {
  EXPECT_NEAR(double(actual), double(expected), double(kRelative) * std::abs(double(expected)));
}

SurfacePoint Floor(const Point3& p) { return {p, {}, {0, 1, 0}}; }

std::optional<LightLiSample> DirectSample(const Light& light, const Point3& p) {
  return light.SampleDirect(Floor(p), {Real(.3), Real(.6)}, Real(.5));
}

// Expects every emitted ray to have the weight Power().
void ExpectConstantWeights(const Light& light) {
  RandomStream random(17);
  const Real power = light.Power().g;
  ASSERT_GT(power, 0);
  for (int i = 0; i < 2000; ++i) {
    const auto sample =
        light.SampleEmission({random.Uniform(), random.Uniform()},
                             {random.Uniform(), random.Uniform()}, random.Uniform(), 0);
    ASSERT_TRUE(sample);
    EXPECT_NEAR(double(sample->power.g), double(power), 1e-4 * double(power));
    EXPECT_NEAR(double(Length(sample->ray.d)), 1, 1e-5);
  }
}

ExitStatus StatusOf(const std::string& text) {
  TestPlugins plugins;
  try {
    plugins.MakeLight(text);
  } catch (const Error& error) {
    return error.Status();
  }
  return ExitStatus::Ok;
}

TEST(PointLight, GivesIntensityOverDistanceSquared) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(R"("point" "color I" [8 4 2] "point from" [0 2 0])");
  const auto sample = DirectSample(*light, {0, 0, 0});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->Li, Spectrum(2, 1, Real(.5)));
  EXPECT_EQ(sample->wi, Vector3(0, 1, 0));
  EXPECT_EQ(sample->pdf, 1);
  EXPECT_TRUE(light->IsDelta());
}

TEST(PointLight, PowerIsFourPiIntensityAndScaleMultipliesIt) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(R"("point" "color I" [1 2 3] "color scale" [2 2 2])");
  ExpectNear(light->Power().b, 6 * 4 * kPi);
  ExpectConstantWeights(*light);
}

TEST(PointLight, OnASurfaceStaysFinite) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(R"("point" "point from" [1 2 3])");
  light->Prepare({{0, 0, 0}, 1});
  EXPECT_FALSE(DirectSample(*light, {1, 2, 3}));
  const auto near = DirectSample(*light, {1, 2, NextUp(3)});
  ASSERT_TRUE(near);
  EXPECT_TRUE(near->Li.IsFinite());
}

TEST(PointLight, KeepsItsLightInAHugeWorld) {
  TestPlugins plugins;
  for (const char* text :
       {R"("point" "point from" [1 2 3])", R"("spot" "point from" [1 2 3] "point to" [1 2 2])"}) {
    const auto light = plugins.MakeLight(text);
    light->Prepare({{0, 0, 0}, Real(1e12)});
    const auto sample = DirectSample(*light, {1, 2, Real(2.5)});
    ASSERT_TRUE(sample);
    EXPECT_EQ(sample->Li, Spectrum(4));
  }
}

TEST(SpotLight, FallsOffByTheFourthPowerBetweenItsCones) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("spot" "point from" [0 0 0] "point to" [0 -1 0]
         "float coneangle" 40 "float conedeltaangle" 20)");
  const auto at = [&](Real degrees) {
    const Real a = Radians(degrees);
    const auto sample = DirectSample(*light, {std::sin(a), -std::cos(a), 0});
    return sample ? sample->Li.g : Real(0);
  };
  EXPECT_NEAR(double(at(0)), 1, 1e-5);
  EXPECT_NEAR(double(at(19)), 1, 1e-5);
  const double delta = (std::cos(30 * M_PI / 180) - std::cos(40 * M_PI / 180)) /
                       (std::cos(20 * M_PI / 180) - std::cos(40 * M_PI / 180));
  EXPECT_NEAR(double(at(30)), std::pow(delta, 4), 1e-5);
  EXPECT_EQ(at(41), 0);
  EXPECT_EQ(at(180), 0);
}

TEST(SpotLight, PowerIsTheIntegralOfItsFalloff) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(R"("spot" "float coneangle" 30 "float conedeltaangle" 5)");
  EXPECT_NEAR(double(light->Power().g), 0.63931, 1e-5);
  ExpectConstantWeights(*light);
}

TEST(SpotLight, WorksForNarrowWideAndSharpCones) {
  TestPlugins plugins;
  for (const char* angles : {"\"float coneangle\" .001 \"float conedeltaangle\" 0",
                             "\"float coneangle\" .001 \"float conedeltaangle\" .001",
                             "\"float coneangle\" 90 \"float conedeltaangle\" 90",
                             "\"float coneangle\" 180 \"float conedeltaangle\" 0",
                             "\"float coneangle\" 30 \"float conedeltaangle\" 0"}) {
    SCOPED_TRACE(angles);
    const auto light = plugins.MakeLight(std::string("\"spot\" ") + angles);
    ExpectConstantWeights(*light);
    const auto onAxis = DirectSample(*light, {0, 0, 1});
    ASSERT_TRUE(onAxis);
    ExpectNear(onAxis->Li.g, 1);
  }
}

TEST(SpotLight, EmitsWhereItLights) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("spot" "point from" [1 2 3] "point to" [2 0 3] "float coneangle" 50
         "float conedeltaangle" 30)");
  RandomStream random(5);
  for (int i = 0; i < 1000; ++i) {
    const auto sample = light->SampleEmission({}, {random.Uniform(), random.Uniform()}, 0, 0);
    ASSERT_TRUE(sample);
    const auto direct = DirectSample(*light, sample->ray(1));
    if (!direct) {
      EXPECT_LT(sample->pdfDirection, 1e-4);
      continue;
    }
    // For unit intensity, pdf = falloff / power.
    EXPECT_NEAR(double(sample->pdfDirection * light->Power().g), double(direct->Li.g), 1e-3);
  }
}

// The fraction of the photons within a cone must be the fraction of the power in the cone.
// With d = (cos - cos total) / (cos inner - cos total), the part of the rim outside d has d^5
// of the rim's power.
TEST(SpotLight, EmitsIntoEachConeWhatItLightsThere) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(
      R"("spot" "point to" [0 0 1] "float coneangle" 60 "float conedeltaangle" 40)");
  const double inner = std::cos(20 * M_PI / 180), total = .5;
  const double ofInner = 1 - inner, ofRim = (inner - total) / 5;
  constexpr int kSide = 200;
  for (const double d : {1., .9, .7, .5}) {
    int within = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const Point2 u((Real(i % kSide) + Real(.5)) / kSide, (Real(i / kSide) + Real(.5)) / kSide);
      const auto sample = light->SampleEmission({}, u, 0, 0);
      within += double(sample->ray.d.z) > total + d * (inner - total);
    }
    const double expected = 1 - ofRim * std::pow(d, 5) / (ofInner + ofRim);
    EXPECT_NEAR(within / double(kSide * kSide), expected, 2. / kSide) << d;
  }
}

TEST(SpotLight, RefusesConesThatAreNone) {
  EXPECT_EQ(StatusOf(R"("spot" "float coneangle" 0)"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("spot" "float coneangle" 181)"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("spot" "float coneangle" 10 "float conedeltaangle" 11)"),
            ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("spot" "float coneangle" 10 "float conedeltaangle" 10)"), ExitStatus::Ok);
  EXPECT_EQ(StatusOf(R"("spot" "point from" [1 1 1] "point to" [1 1 1])"), ExitStatus::Scene);
}

TEST(SpotLight, HasARimOfFiveDegreesOrOfItsWholeConeIfTheFileStatesNone) {
  TestPlugins plugins;
  const auto power = [&](const char* angles) {
    return plugins.MakeLight(std::string("\"spot\" \"float coneangle\" ") + angles)->Power();
  };
  EXPECT_EQ(power("3"), power("3 \"float conedeltaangle\" 3"));
  EXPECT_EQ(power("20"), power("20 \"float conedeltaangle\" 5"));
  EXPECT_EQ(StatusOf(R"("spot" "float coneangle" 3 "float conedeltaangle" 5)"), ExitStatus::Scene);
}

TEST(SpotLight, StaysCircularUnderAStretchAndSaysSo) {
  TestPlugins plugins;
  const auto light =
      plugins.MakeLight(R"("spot" "float coneangle" 30)", *Transform::Scale(1, 1, 5));
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
  ExpectConstantWeights(*light);
  plugins.MakeLight(R"("spot" "float coneangle" 30)", *Transform::Scale(-3, 3, 3));
  EXPECT_EQ(plugins.GetLog().WarningCount(), 1);
}

TEST(DistantLight, ShinesFromTowardsToWithUnitDirections) {
  TestPlugins plugins;
  const auto light =
      plugins.MakeLight(R"("distant" "color L" [3 3 3] "point from" [0 5 0] "point to" [0 0 0])",
                        *Transform::Scale(2, 7, 2));
  light->Prepare({{1, 2, 3}, 4});
  const auto sample = DirectSample(*light, {0, 0, 0});
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->wi, Vector3(0, 1, 0));
  EXPECT_EQ(sample->Li, Spectrum(3));
  ExpectNear(light->Power().g, 3 * kPi * 16);
  ExpectConstantWeights(*light);
  RandomStream random(3);
  for (int i = 0; i < 100; ++i) {
    const auto emission = light->SampleEmission({random.Uniform(), random.Uniform()}, {}, 0, 0);
    const Vector3 fromCentre = emission->ray.o - Point3(1, 2, 3);
    EXPECT_GE(Length(fromCentre), 4);
    EXPECT_LE(Length(Cross(fromCentre, emission->ray.d)), Real(4.0001));
  }
}

TEST(DistantLight, InAnEmptyWorldHasNoPowerAndEmitsNothing) {
  TestPlugins plugins;
  for (const char* text : {"\"distant\"", "\"infinite\""}) {
    const auto light = plugins.MakeLight(text);
    light->Prepare({});
    EXPECT_EQ(light->Power(), Spectrum());
    EXPECT_FALSE(light->SampleEmission({Real(.5), Real(.5)}, {Real(.5), Real(.5)}, Real(.5), 0));
  }
}

TEST(Lights, RefuseNegativeColoursAndMissingDirections) {
  EXPECT_EQ(StatusOf(R"("point" "color I" [1 -1 1])"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("distant" "color L" [-1 0 0])"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("infinite" "color scale" [1 1 -1])"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("distant" "point from" [1 2 3] "point to" [1 2 3])"), ExitStatus::Scene);
  EXPECT_EQ(StatusOf(R"("infinite" "string mapname" "no/such.exr")"), ExitStatus::Scene);
}

TEST(Lights, OfColourBlackAreProvablyBlack) {
  TestPlugins plugins;
  for (const char* text : {R"("point" "color I" [0 0 0])", R"("spot" "color scale" [0 0 0])",
                           R"("distant" "color L" [0 0 0])", R"("infinite" "color L" [0 0 0])"}) {
    EXPECT_TRUE(plugins.MakeLight(text)->IsProvablyBlack()) << text;
  }
  EXPECT_FALSE(plugins.MakeLight(R"("point" "color I" [0 0 1e-30])")->IsProvablyBlack());
}

TEST(AreaLight, EmitsOnTheSideOfItsNormalOnly) {
  TestPlugins plugins;
  const auto surface = plugins.MakeEmitter(R"("disk" "float radius" 2)");
  const auto light = plugins.MakeAreaLight(R"("area" "color L" [5 5 5])", surface);
  const SurfacePoint on = surface->SamplePoint({Real(.2), Real(.7)}, Real(.5), 0).point;
  EXPECT_EQ(light->L(on, {}, on.ng), Spectrum(5));
  EXPECT_EQ(light->L(on, {}, -on.ng), Spectrum());
  EXPECT_TRUE(DirectSample(*light, on.ng * 3));
  EXPECT_FALSE(DirectSample(*light, on.ng * Real(-3)));
}

TEST(AreaLight, PowerIsPiTimesAreaTimesRadiance) {
  TestPlugins plugins;
  const auto surface = plugins.MakeEmitter(R"("disk" "float radius" 2)");
  const auto light = plugins.MakeAreaLight(R"("diffuse" "color L" [5 5 5])", surface);
  ExpectNear(light->Power().g, kPi * (4 * kPi) * 5);
  ExpectConstantWeights(*light);
}

// Where a stretched sphere is sampled less densely, its photons carry more: each pi L / density.
TEST(AreaLight, PhotonsOfAStretchedSphereBalanceItsDensity) {
  TestPlugins plugins;
  const auto surface = plugins.MakeEmitter(R"("sphere")", *Transform::Scale(1, 1, 4));
  const auto light = plugins.MakeAreaLight(R"("area" "color L" [5 5 5])", surface);
  RandomStream random(17);
  for (int i = 0; i < 200; ++i) {
    const auto sample =
        light->SampleEmission({random.Uniform(), random.Uniform()},
                              {random.Uniform(), random.Uniform()}, random.Uniform(), 0);
    ASSERT_TRUE(sample);
    ExpectNear(sample->power.g * sample->pdfPosition, kPi * 5);
  }
}

TEST(InfiniteLight, UniformSkyHasPowerFourPiSquaredRadiusSquared) {
  TestPlugins plugins;
  const auto light = plugins.MakeLight(R"("infinite" "color L" [2 2 2])");
  light->Prepare({{0, 1, 0}, 3});
  ExpectNear(light->Power().g, 4 * kPi * kPi * 9 * 2);
  ExpectConstantWeights(*light);
}

}  // namespace
}  // namespace exphoton
