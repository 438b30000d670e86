// SPDX-License-Identifier: BSD-2-Clause
// These tests check the lights "goniometric" and "projection": the axes and edges of their images,
// their power against the sum of the irradiance on a sphere or a plane around them, and values that
// are no intensity. The light "infinitesample" must be the light "infinite".
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/imaging/files/exr.h"
#include "core/lights/emission_cone.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

class MappedPointLights : public testing::Test {
 protected:
  // Writes the grey values row by row and returns the text of parameter mapname.
  std::string Map(int width, int height, const std::vector<float>& grey) {
    Image image(width, height, {"R", "G", "B"});
    for (int i = 0; i < width * height; ++i)
      for (int c = 0; c < 3; ++c) image.At(i % width, i / width, c) = grey[std::size_t(i)];
    const std::string path = testing::TempDir() + "exphoton_mapped_" +
                             testing::UnitTest::GetInstance()->current_test_info()->name() + "_" +
                             std::to_string(width) + "x" + std::to_string(height) + ".exr";
    WriteExr(path, image, false);
    return " \"string mapname\" \"" + path + "\"";
  }
  std::unique_ptr<Light> Make(const std::string& text, const Transform& toWorld = {}) {
    auto light = plugins_.MakeLight(text, toWorld);
    light->Prepare({{0, 0, 0}, 10});
    return light;
  }
  // Returns the green light that arrives at p: the irradiance on a plane perpendicular to it.
  static double At(const Light& light, const Point3& p) {
    const auto sample = light.SampleDirect({p, {}, {0, 1, 0}}, {Real(.3), Real(.6)}, Real(.5));
    return sample ? double(sample->Li.g) : 0;
  }
  void ExpectError(const std::string& text) {
    EXPECT_THROW(plugins_.MakeLight(text), Error) << text;
  }

  TestPlugins plugins_;
};

// Integrates the irradiance over a sphere of radius r about the origin, by the midpoint rule.
template <class At>
double PowerThroughSphere(double r, const At& at) {
  constexpr int kSteps = 600;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Real z = Real(-1 + (i + .5) * 2 / kSteps), phi = Real((j + .5) * 2 * M_PI / kSteps);
      sum += at(SphericalDirection(SafeSqrt(1 - z * z), z, phi) * Real(r));
    }
  }
  return sum * 4 * M_PI * r * r / (double(kSteps) * kSteps);
}

std::vector<float> Steps(int count) {
  std::vector<float> grey;
  for (int i = 0; i < count; ++i) grey.push_back(float((i * 7) % 5));
  return grey;
}

TEST_F(MappedPointLights, WithoutAMapGoniometricIsAPointLight) {
  const auto light = Make(R"("goniometric" "color I" [3 6 9] "color scale" [1 .5 1])",
                          Transform::Translate({1, 2, 3}));
  EXPECT_NEAR(At(*light, {1, 4, 3}), 3. / 4, 1e-6);
  EXPECT_NEAR(double(light->Power().g), 3 * 4 * M_PI, 1e-4);
  EXPECT_NEAR(double(light->Power().b), 9 * 4 * M_PI, 1e-4);
  EXPECT_TRUE(light->IsDelta());
  ASSERT_TRUE(light->Bounds());
  EXPECT_EQ(light->Bounds()->min, Point3(1, 2, 3));
}

TEST_F(MappedPointLights, GoniometricHasItsTopRowAtPlusYAndTurnsFromXToZ) {
  // Texel centres of the 4 x 2 map: azimuths of 45, 135, 225 and 315 degrees, 45 degrees from +y
  // or -y.
  const auto light = Make("\"goniometric\"" + Map(4, 2, {1, 2, 3, 4, 5, 6, 7, 8}));
  const Real h = std::sqrt(Real(.5)), q = Real(.5);
  EXPECT_NEAR(At(*light, {q, h, q}), 1, 1e-5);
  EXPECT_NEAR(At(*light, {-q, h, q}), 2, 1e-5);
  EXPECT_NEAR(At(*light, {-q, h, -q}), 3, 1e-5);
  EXPECT_NEAR(At(*light, {q, h, -q}), 4, 1e-5);
  EXPECT_NEAR(At(*light, {q, -h, q}), 5, 1e-5);
  EXPECT_NEAR(At(*light, {2 * q, -2 * h, -2 * q}), 8 / 4., 1e-5);
}

TEST_F(MappedPointLights, GoniometricTurnsWithItsTransformation) {
  const std::string text = "\"goniometric\"" + Map(4, 2, {1, 2, 3, 4, 5, 6, 7, 8});
  const Transform place = Transform::Translate({5, 0, 0}) * *Transform::Rotate(90, {0, 0, 1}) *
                          *Transform::Scale(2, 2, 2);
  const auto light = Make(text, place);
  const Real h = std::sqrt(Real(.5)), q = Real(.5);
  const Vector3 w = Normalize(place.ApplyVector({-q, h, q}));
  EXPECT_NEAR(At(*light, Point3(5, 0, 0) + w), 2, 1e-4);
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 0);
}

TEST_F(MappedPointLights, PowerOfGoniometricIsTheIrradianceOfASphereAroundIt) {
  for (const auto& [width, height] :
       std::vector<std::pair<int, int>>{{4, 2}, {7, 3}, {2, 1}, {1, 5}, {16, 9}}) {
    const auto light =
        Make("\"goniometric\" \"color I\" [2 2 2]" + Map(width, height, Steps(width * height)));
    const double sum = PowerThroughSphere(2, [&](const Point3& p) { return At(*light, p); });
    EXPECT_NEAR(double(light->Power().g) / sum, 1, 2e-3) << width << " x " << height;
  }
}

// The centres of the four rows are at 22.5, 67.5 ... degrees. An outermost row is even from its
// centre to the pole, and fades out up to the centre of its neighbour.
TEST_F(MappedPointLights, PowerOfTheOutermostRowsOfGoniometricIsTheClosedForm) {
  const double a = M_PI / 8, b = 3 * M_PI / 8;
  const double truth = 2 * M_PI * (1 - (std::sin(b) - std::sin(a)) / (b - a));
  for (const std::size_t row : {0, 3}) {
    std::vector<float> grey(32);
    for (std::size_t x = 0; x < 8; ++x) grey[8 * row + x] = 1;
    const auto light = Make("\"goniometric\"" + Map(8, 4, grey));
    EXPECT_NEAR(double(light->Power().g), truth, 1e-4 * truth) << row;
  }
}

TEST_F(MappedPointLights, MapOfOneColourIsAPointLight) {
  const auto light = Make("\"goniometric\"" + Map(5, 3, std::vector<float>(15, 2.f)));
  EXPECT_NEAR(double(light->Power().g), 8 * M_PI, 1e-4);
  EXPECT_NEAR(At(*light, {0, 0, 1}), 2, 1e-6);
}

TEST_F(MappedPointLights, ProjectionHasItsFirstRowAtMinusYAndLooksAlongZ) {
  // With a field of view of 90 degrees, the texel centres are at X, Y = -.5 and .5 for z = 1.
  const auto light = Make("\"projection\" \"float fov\" 90" + Map(2, 2, {1, 2, 3, 4}));
  const double cos3 = 1.5;  // squared distance to these points
  EXPECT_NEAR(At(*light, {Real(-.5), Real(-.5), 1}), 1 / cos3, 1e-5);
  EXPECT_NEAR(At(*light, {Real(.5), Real(-.5), 1}), 2 / cos3, 1e-5);
  EXPECT_NEAR(At(*light, {Real(-.5), Real(.5), 1}), 3 / cos3, 1e-5);
  EXPECT_NEAR(At(*light, {Real(.5), Real(.5), 1}), 4 / cos3, 1e-5);
  EXPECT_NEAR(At(*light, {0, 0, 2}), 2.5 / 4, 1e-5);
}

TEST_F(MappedPointLights, ProjectionIsDarkOutsideItsImageAndBehind) {
  const auto light = Make("\"projection\" \"float fov\" 90");
  EXPECT_GT(At(*light, {Real(.999), 0, 1}), 0);
  EXPECT_EQ(At(*light, {Real(1.001), 0, 1}), 0);
  EXPECT_EQ(At(*light, {0, Real(-1.001), 1}), 0);
  EXPECT_EQ(At(*light, {Real(-.5), Real(-.5), -1}), 0);
  EXPECT_EQ(At(*light, {1, 0, 0}), 0);
}

TEST_F(MappedPointLights, FieldOfViewIsThatAngleOfTheShorterAxis) {
  const Real t = std::tan(Radians(30));
  const auto wide = Make("\"projection\" \"float fov\" 60" + Map(4, 1, {1, 1, 1, 1}));
  EXPECT_GT(At(*wide, {4 * t * Real(.999), 0, 1}), 0);
  EXPECT_EQ(At(*wide, {4 * t * Real(1.001), 0, 1}), 0);
  EXPECT_GT(At(*wide, {0, t * Real(.999), 1}), 0);
  EXPECT_EQ(At(*wide, {0, t * Real(1.001), 1}), 0);
  const auto high = Make("\"projection\" \"float fov\" 60" + Map(1, 3, {1, 1, 1}));
  EXPECT_GT(At(*high, {t * Real(.999), 3 * t * Real(.999), 1}), 0);
  EXPECT_EQ(At(*high, {0, 3 * t * Real(1.001), 1}), 0);
  EXPECT_EQ(At(*high, {t * Real(1.001), 0, 1}), 0);
}

// A square pyramid of 90 degrees is one side of a cube about its apex: a sixth of the sphere.
TEST_F(MappedPointLights, WithoutAMapProjectionFillsASquare) {
  const auto right = Make("\"projection\" \"color I\" [3 3 3] \"float fov\" 90");
  EXPECT_NEAR(double(right->Power().g), 3 * 4 * M_PI / 6, 1e-5);
  const double t = std::tan(22.5 * M_PI / 180);
  const auto standard = Make("\"projection\"");
  EXPECT_NEAR(double(standard->Power().g), 4 * std::atan(t * t / std::sqrt(1 + 2 * t * t)), 1e-6);
}

// The irradiance on the plane z = 2, summed over the image that the light throws there.
TEST_F(MappedPointLights, PowerOfProjectionIsTheIrradianceOfAPlane) {
  struct Case {
    int width, height;
    double fov;
  };
  for (const Case& c : {Case{2, 2, 45}, Case{3, 2, 90}, Case{2, 5, 130}, Case{40, 30, 60}}) {
    const auto light = Make("\"projection\" \"float fov\" " + std::to_string(c.fov) +
                            Map(c.width, c.height, Steps(c.width * c.height)));
    const double t = std::tan(c.fov * M_PI / 360), aspect = double(c.width) / c.height;
    const double a = 2 * t * std::max(aspect, 1.), b = 2 * t * std::max(1 / aspect, 1.);
    constexpr int kSteps = 900;
    double sum = 0;
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const double x = (2 * (i % kSteps + .5) / kSteps - 1) * a;
      const double y = (2 * (i / kSteps + .5) / kSteps - 1) * b;
      sum += At(*light, {Real(x), Real(y), 2}) * 2 / std::sqrt(x * x + y * y + 4);
    }
    sum *= 4 * a * b / (double(kSteps) * kSteps);
    EXPECT_NEAR(double(light->Power().g) / sum, 1, 2e-3) << c.width << " x " << c.height;
  }
}

TEST_F(MappedPointLights, EveryPhotonOfAUniformProjectionHasItsPower) {
  for (const char* fov : {".001", "45", "130", "179"}) {
    SCOPED_TRACE(fov);
    const auto light = Make(std::string("\"projection\" \"float fov\" ") + fov);
    const double t = std::tan(std::stod(fov) * M_PI / 360);
    RandomStream random(17);
    double sum = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i) {
      const auto sample = light->SampleEmission({}, {random.Uniform(), random.Uniform()}, 0, 0);
      ASSERT_TRUE(sample);
      // Within a cell, points are uniform on the plane, so weights vary a little.
      if (t < 3) {
        EXPECT_NEAR(double(sample->power.g / light->Power().g), 1, .1);
      }
      sum += double(sample->power.g);
    }
    EXPECT_NEAR(sum / kSamples / double(light->Power().g), 1, t < 3 ? .002 : .2);
  }
}

// The interpolated image lights the black columns up to their centres. Images have 1, 3 and 1 cells
// for a texel.
TEST_F(MappedPointLights, PhotonsOfAStripedProjectionCoverItsLightAndHaveItsPower) {
  struct Case {
    int width, height;
    double fov;
  };
  for (const Case& c : {Case{256, 256, 45}, Case{21, 21, 10}, Case{1100, 4, 2}}) {
    SCOPED_TRACE(c.width);
    std::vector<float> stripes;
    for (int i = 0; i < c.width * c.height; ++i) stripes.push_back(float(i % c.width % 2));
    const auto light = Make("\"projection\" \"float fov\" " + std::to_string(c.fov) +
                            Map(c.width, c.height, stripes));
    RandomStream random(11);
    double sum = 0;
    constexpr int kSamples = 40000;
    for (int i = 0; i < kSamples; ++i) {
      const auto sample = light->SampleEmission({}, {random.Uniform(), random.Uniform()}, 0, 0);
      if (sample) sum += double(sample->power.g);
    }
    EXPECT_NEAR(sum / kSamples / double(light->Power().g), 1, .015);
    const double a = std::tan(c.fov * M_PI / 360) * c.width / c.height;
    for (int i = 0; i < 2000; ++i) {
      const Vector3 w = Normalize(Vector3(Real(((i + .5) / 1000 - 1) * a), Real(1e-3), 1));
      EXPECT_TRUE(At(*light, w) == 0 || light->PdfEmission({}, w).direction > 0) << i;
    }
  }
}

TEST_F(MappedPointLights, ScaleAndIntensityMultiply) {
  for (const char* name : {"goniometric", "projection"}) {
    const std::string text = "\"" + std::string(name) + "\"" + Map(2, 2, {1, 2, 3, 4});
    const auto one = Make(text), six = Make(text + R"("color I" [2 2 2] "color scale" [3 3 3])");
    EXPECT_NEAR(double(six->Power().g), 6 * double(one->Power().g), 1e-4);
    EXPECT_NEAR(At(*six, {0, 0, 3}), 6 * At(*one, {0, 0, 3}), 1e-5);
    EXPECT_GT(At(*one, {0, 0, 3}), 0);
  }
}

TEST_F(MappedPointLights, WithTexelsThatAreNoIntensityWarnOnceAndStayFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  int warnings = 0;
  for (const char* name : {"goniometric", "projection"}) {
    const auto light = Make("\"" + std::string(name) + "\"" +
                            Map(4, 2, {nan, inf, -1.f, 1.f, 0.f, 0.f, 2.f, 0.f}));
    EXPECT_EQ(plugins_.GetLog().WarningCount(), ++warnings);
    EXPECT_TRUE(light->Power().IsFinite());
    EXPECT_GT(light->Power().g, 0);
    EXPECT_FALSE(light->IsProvablyBlack());
  }
}

TEST_F(MappedPointLights, ThatAreBlackAreOffWithAWarning) {
  for (const char* name : {"goniometric", "projection"}) {
    const std::string text = "\"" + std::string(name) + "\"";
    EXPECT_TRUE(Make(text + Map(3, 2, std::vector<float>(6, 0.f)))->IsProvablyBlack());
    EXPECT_TRUE(Make(text + " \"color I\" [0 0 0]")->IsProvablyBlack());
    EXPECT_FALSE(Make(text + " \"color I\" [0 0 1e-30]")->IsProvablyBlack());
  }
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 2);
}

TEST_F(MappedPointLights, RefuseWhatIsNoMapAndNoAngle) {
  ExpectError(R"("goniometric" "string mapname" "no/such.exr")");
  ExpectError(R"("projection" "string mapname" "no/such.exr")");
  ExpectError(R"("projection" "float fov" 0)");
  ExpectError(R"("projection" "float fov" 180)");
  ExpectError(R"("goniometric" "color I" [1 -1 1])");
}

TEST_F(MappedPointLights, UnderAStretchWarn) {
  Make("\"goniometric\"" + Map(2, 1, {1, 2}), *Transform::Scale(1, 1, 3));
  Make("\"projection\"", *Transform::Scale(1, 1, 3));
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 2);
}

TEST_F(MappedPointLights, OnASurfaceStayFinite) {
  for (const char* name : {"goniometric", "projection"}) {
    const auto light = Make("\"" + std::string(name) + "\"", Transform::Translate({1, 2, 3}));
    EXPECT_EQ(At(*light, {1, 2, 3}), 0);
    EXPECT_TRUE(std::isfinite(At(*light, {1, 2, NextUp(3)})));
    EXPECT_GT(At(*light, {1, 2, NextUp(3)}), 0);
  }
}

TEST_F(MappedPointLights, InfiniteSampleIsTheLightInfiniteBitForBit) {
  const std::string map = Map(8, 4, Steps(32)) + R"( "color L" [2 1 3] "integer nsamples" 4)";
  const auto a = Make("\"infinite\"" + map), b = Make("\"infinitesample\"" + map);
  EXPECT_EQ(a->Power(), b->Power());
  EXPECT_EQ(b->SampleCount(), 4);
  RandomStream random(3);
  for (int i = 0; i < 200; ++i) {
    const Point2 u{random.Uniform(), random.Uniform()};
    const SurfacePoint ref{{1, 2, 3}, {}, {0, 1, 0}};
    const auto x = a->SampleDirect(ref, u, 0), y = b->SampleDirect(ref, u, 0);
    ASSERT_EQ(bool(x), bool(y));
    if (!x) continue;
    EXPECT_EQ(x->wi, y->wi);
    EXPECT_EQ(x->Li, y->Li);
    EXPECT_EQ(x->pdf, y->pdf);
  }
}

// Returns the half-angle of the light's cone. Expects that it contains the rays of photons.
double ConeAngleOf(const Light& light) {
  const auto* const emitter = dynamic_cast<const ConeEmitter*>(&light);
  if (!emitter) return 0;
  const EmissionCone cone = emitter->Cone();
  for (int i = 0; i < 10000; ++i) {
    const Point2 u{Real((i % 100 + .5) / 100), Real((i / 100 + .5) / 100)};
    const auto sample = light.SampleEmission({}, u, 0, 0);
    if (!sample) continue;
    const double cosine = std::clamp(double(Dot(sample->ray.d, cone.axis)), -1., 1.);
    EXPECT_LE(std::acos(cosine), cone.angle + 1e-3);
  }
  return cone.angle;
}

// The corner of a square image with an angle of 90 degrees is 54.7 degrees away from the axis.
TEST_F(MappedPointLights, HaveCones) {
  const Transform turn = *Transform::Rotate(40, {1, 2, 3});
  EXPECT_NEAR(ConeAngleOf(*Make("\"projection\" \"float fov\" 90", turn)), std::atan(std::sqrt(2.)),
              1e-6);
  std::vector<float> down(4 * 32), up(4 * 32);
  down[4 * 31] = up[4 * 3 + 2] = 1;
  EXPECT_NEAR(ConeAngleOf(*Make("\"goniometric\"" + Map(4, 32, down), turn)), 3 * M_PI / 32, 1e-6);
  EXPECT_NEAR(ConeAngleOf(*Make("\"goniometric\"" + Map(4, 32, up), turn)), 6 * M_PI / 32, 1e-6);
  EXPECT_GT(ConeAngleOf(*Make("\"goniometric\"")), M_PI);
  EXPECT_GT(ConeAngleOf(*Make("\"projection\"", *Transform::Scale(1, 1, 2))), M_PI);
}

}  // namespace
}  // namespace exphoton
