// SPDX-License-Identifier: BSD-2-Clause
// These tests check material "measured" with files that the tests write: a Lambertian table, the
// place of each cell, samples at irregular directions, and files that are wrong.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "core/base/arena.h"
#include "core/base/error.h"
#include "core/math/cie.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

// Writes a table of 90 x 90 x 180 cells of grey values per steradian, value(half, difference,
// azimuth).
template <class Value>
std::string WriteTable(const std::string& name, const Value& value) {
  const std::string path = testing::TempDir() + "exphoton_" + name + ".binary";
  std::ofstream file(path, std::ios::binary);
  const std::int32_t sizes[3] = {90, 90, 180};
  file.write(reinterpret_cast<const char*>(sizes), sizeof sizes);
  for (const double scale : {1 / 1500., 1.15 / 1500, 1.66 / 1500}) {
    std::vector<double> cells;
    for (int i = 0; i < 90; ++i)
      for (int j = 0; j < 90; ++j)
        for (int k = 0; k < 180; ++k) cells.push_back(value(i, j, k) / scale);
    file.write(reinterpret_cast<const char*>(cells.data()), std::streamsize(8 * cells.size()));
  }
  return path;
}

std::string WriteText(const std::string& name, const std::string& text) {
  const std::string path = testing::TempDir() + "exphoton_" + name + ".brdf";
  std::ofstream(path) << text;
  return path;
}

class Measured : public testing::Test {
 protected:
  std::string Text(const std::string& path) {
    return "\"measured\" \"string filename\" \"" + path + "\"";
  }
  Bsdf Evaluate(const std::string& path) {
    SurfaceInteraction si = FlatSurface();
    materials_.push_back(plugins_.MakeMaterial(Text(path)));
    return materials_.back()->Evaluate(&si, TransportMode::Radiance, &arena_);
  }
  // Returns the message of the error, or "" if there is none.
  std::string ErrorOf(const std::string& path) {
    try {
      plugins_.MakeMaterial(Text(path));
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  // Expects the BRDF of a Lambertian surface.
  void ExpectLambertian(const Bsdf& bsdf, double reflectance) {
    for (const Vector3& wo : Directions({1, Real(.9), Real(.4), Real(.05), Real(-.5)})) {
      RandomStream random(4);
      Spectrum albedo;
      constexpr int kSamples = 4096;
      for (int i = 0; i < kSamples; ++i) {
        const Point2 u((Real(i % 64) + Real(.5)) / 64, (Real(i / 64) + Real(.5)) / 64);
        const auto sample = bsdf.Sample(wo, u, random.Uniform());
        if (!sample) continue;
        albedo += sample->throughput;
        EXPECT_NEAR(double(bsdf.f(wo, sample->wi).g), reflectance / M_PI, 1e-5);
      }
      EXPECT_NEAR(double(albedo.g) / kSamples, reflectance, .02 * reflectance) << wo.z;
    }
    EXPECT_NEAR(double(bsdf.Rho(LobeSet::All).g), reflectance, .02 * reflectance);
  }

  TestPlugins plugins_;
  std::vector<std::unique_ptr<Material>> materials_;
  Arena arena_;
};

TEST_F(Measured, LambertianTableIsLambertian) {
  const std::string path = WriteTable("lambertian", [](int, int, int) { return .6 / M_PI; });
  ExpectLambertian(Evaluate(path), .6);
  const Spectrum f = Evaluate(path).f({0, 0, 1}, {Real(.6), 0, Real(.8)});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(f[c]), .6 / M_PI, 1e-6);
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 0);
}

TEST_F(Measured, TableHasItsCellsAtTheHalfAngleAndTheDifference) {
  const Bsdf bsdf =
      Evaluate(WriteTable("cells", [](int i, int j, int k) { return 1 + i + 2. * j + 4. * k; }));
  for (const auto& [i, j, k] : std::vector<std::array<int, 3>>{
           {50, 30, 60}, {30, 20, 90}, {12, 40, 10}, {40, 5, 170}, {20, 30, 135}}) {
    const double half = (i + .5) * (i + .5) / 8100 * M_PI / 2;
    const double difference = (j + .5) / 90 * M_PI / 2, azimuth = (k + .5) / 180 * M_PI;
    // In the frame of h, x points away from the normal. The half vector is turned about z by .4.
    const double turn = .4;
    const auto world = [&](double x, double y, double z) {
      const double across = x * std::cos(half) + z * std::sin(half);
      const double up = -x * std::sin(half) + z * std::cos(half);
      return Vector3(Real(across * std::cos(turn) - y * std::sin(turn)),
                     Real(across * std::sin(turn) + y * std::cos(turn)), Real(up));
    };
    const double dx = std::sin(difference) * std::cos(azimuth);
    const double dy = std::sin(difference) * std::sin(azimuth);
    const Vector3 wi = world(dx, dy, std::cos(difference));
    const Vector3 wo = world(-dx, -dy, std::cos(difference));
    ASSERT_GT(std::min(wi.z, wo.z), 0);
    const double expected = 1 + i + 2. * j + 4. * k;
    EXPECT_NEAR(double(bsdf.f(wo, wi).g), expected, .02) << i << ' ' << j << ' ' << k;
    EXPECT_NEAR(double(bsdf.f(wi, wo).g), expected, .02);
  }
}

// Light in the plane of incidence lies between the last and the first azimuth.
TEST_F(Measured, TheFirstAzimuthFollowsTheLast) {
  const Bsdf bsdf = Evaluate(WriteTable("azimuths", [](int, int, int k) {
    return k == 0 ? .3 : k == 179 ? .1 : .9;
  }));
  const Vector3 wo(Real(.6), 0, Real(.8));
  for (const Vector3& wi : {Vector3(Real(-.28), 0, Real(.96)), Vector3(Real(.8), 0, Real(.6))})
    EXPECT_NEAR(double(bsdf.f(wo, wi).g), .2, 1e-3) << wi.x;
}

TEST_F(Measured, MissingCellsAreLeftOutOfTheInterpolation) {
  const std::string path =
      WriteTable("missing", [](int i, int j, int) { return (i + j) % 2 == 0 ? -1 : .6 / M_PI; });
  ExpectLambertian(Evaluate(path), .6);
}

TEST_F(Measured, TableIsBrightestWhereItSaysAndSampledThere) {
  const Bsdf bsdf =
      Evaluate(WriteTable("glossy", [](int i, int, int) { return i < 10 ? 20. : .01; }));
  // The first ten half angles end at 90 (10/90)^2 = 1.11 degrees.
  const Vector3 wo(Real(.6), 0, Real(.8));
  RandomStream random(3);
  int near = 0, all = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto sample = bsdf.Sample(wo, {random.Uniform(), random.Uniform()}, random.Uniform());
    if (!sample) continue;
    ++all;
    near += Normalize(wo + sample->wi).z > std::cos(Radians(Real(1.2)));
  }
  EXPECT_GT(near, all / 5);
  EXPECT_GT(bsdf.f(wo, {Real(-.6), 0, Real(.8)}).g, 19);
}

std::string Grid(double value) {
  std::string text = "# wavelengths\n2 400 700\n";
  for (int i = 0; i < 5; ++i)
    for (int o = 0; o < 5; ++o)
      for (int a = 0; a < 4; ++a)
        text += std::to_string(i * .35) + " " + std::to_string(a * .5) + " " +
                std::to_string(o * .35) + " 0  " + std::to_string(value) + " " +
                std::to_string(value) + "\n";
  return text;
}

TEST_F(Measured, SamplesOfOneValueAreLambertian) {
  const Spectrum unit = RgbFromSamples({{400, 1}, {700, 1}});
  ExpectLambertian(Evaluate(WriteText("flat", Grid(.2))), .2 * M_PI * double(unit.g));
}

TEST_F(Measured, SampleHasItsValueAndOthersAreBetween) {
  std::string text = "1 550\n";
  const auto value = [](double polar) { return .1 + polar; };
  for (int i = 0; i < 16; ++i)
    text += std::to_string(i * .1) + " 1 .5 1 " + std::to_string(value(i * .1)) + "\n";
  const Bsdf bsdf = Evaluate(WriteText("line", text));
  const auto at = [&](double polar) {
    const Vector3 wi = SphericalDirection(Real(std::sin(polar)), Real(std::cos(polar)), Real(2));
    const Vector3 wo = SphericalDirection(std::sin(Real(.5)), std::cos(Real(.5)), Real(2));
    return double(bsdf.f(wo, wi).g) / double(RgbFromSamples({{550, 1}}).g);
  };
  for (const double polar : {.1, .6, 1.1}) EXPECT_NEAR(at(polar), value(polar), 1e-3) << polar;
  // The mean is continuous: near a sample, its weight exceeds the others.
  EXPECT_NEAR(at(.101), value(.1), .01);
  EXPECT_GT(at(.65), value(.6));
  EXPECT_LT(at(.65), value(.7));
}

TEST_F(Measured, OneSampleIsEnough) {
  ExpectLambertian(Evaluate(WriteText("one", "1 550  0 0 0 0  .1")),
                   .1 * M_PI * double(RgbFromSamples({{550, 1}}).g));
}

TEST_F(Measured, FilesThatAreWrongNameTheFileAndWhatWasExpected) {
  const auto expect = [&](const std::string& path, const std::string& what) {
    const std::string error = ErrorOf(path);
    EXPECT_NE(error.find(what), std::string::npos) << error;
    EXPECT_NE(error.find(path), std::string::npos) << error;
    EXPECT_EQ(error.rfind("parameter \"filename\" of ", 0), 0u) << error;
  };
  expect("/no/such.binary", "no such file");
  expect("/no/such.brdf", "no such file");
  const std::string folder = testing::TempDir();
  expect(folder, "is a directory");
  const std::string empty = folder + "exphoton_empty.binary";
  std::ofstream(empty).close();
  expect(empty, "expected the sizes 90, 90 and 180");
  const std::string cut = folder + "exphoton_cut.binary";
  const std::int32_t sizes[3] = {90, 90, 180};
  std::ofstream(cut, std::ios::binary).write(reinterpret_cast<const char*>(sizes), sizeof sizes);
  expect(cut, "has 12 bytes; a table of 90 x 90 x 180 cells has 34992012");
  const std::int32_t other[3] = {90, 90, 360};
  std::ofstream(cut, std::ios::binary).write(reinterpret_cast<const char*>(other), sizeof other);
  expect(cut, "expected the sizes 90, 90 and 180");
  expect(WriteText("none", "# nothing\n"), "must begin with the number of wavelengths");
  expect(WriteText("many", "1e9 1 2"), "must begin with the number of wavelengths");
  expect(WriteText("word", "1 550\n0 0 0 zero 1\n"), ":2: expected a finite number");
  expect(WriteText("infinite", "1 550\n\n0 0 0 0 inf\n"), ":3: expected a finite number");
  expect(WriteText("short", "1 550 0 0 0 0"), "has 6 numbers; expected 1, then 1 wavelengths");
  expect(WriteText("falling", "2 700 400 0 0 0 0 1 1"),
         "the wavelengths must be positive and rise");
  expect(WriteText("below", "1 550 2 0 0 0 1"), "sample 1 has a polar angle");
}

TEST_F(Measured, TableThatGainsEnergyWarns) {
  Evaluate(WriteText("bright", Grid(1)));
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
}

}  // namespace
}  // namespace exphoton
