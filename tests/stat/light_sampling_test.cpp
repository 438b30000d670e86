// SPDX-License-Identifier: BSD-2-Clause
// These tests check that lights have the densities that they state, for directions towards them and
// for directions and positions of the rays that they emit. The mean weight of these rays must be
// the light's power. The false-alarm rate is 1 % over all chi-square tests of this file.
#include <gtest/gtest.h>

#include "core/imaging/files/exr.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/chi_square.h"
#include "tests/support/equivalence.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr int kLightTests = 25;
const Sphere3 kWorld{{1, -2, Real(.5)}, 3};

// Writes a map with every kind of texel: black, dim, bright and coloured. The rows at the
// poles are bright.
std::string WriteMap(int width, int height, const std::string& light = "infinite") {
  Image image(width, height, {"R", "G", "B"});
  RandomStream random(99);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const bool isBlack = (x + 2 * y) % 5 == 0;
        const bool isPole = y == 0 || y == height - 1;
        image.At(x, y, c) = isBlack ? 0 : float(random.Uniform()) * (isPole ? 5.f : 1.f);
      }
    }
  }
  const std::string path = testing::TempDir() + "exphoton_sky_" + std::to_string(width) + "x" +
                           std::to_string(height) + ".exr";
  WriteExr(path, image, false);
  return "\"" + light + "\" \"string mapname\" \"" + path + "\"";
}

Transform Tilted() { return *Transform::Rotate(37, {1, 2, 3}) * *Transform::Scale(-1, 1, 1); }
Transform Stretched() {
  return *Transform::Rotate(20, {3, 1, 2}) * *Transform::Scale(1, 2, Real(.7));
}

struct LightCase {
  const char* name;
  std::string text;
  Transform toWorld;

  friend void PrintTo(const LightCase& c, std::ostream* out) { *out << c.name; }
};

std::vector<LightCase> PlainLights() {
  return {{"Point", R"("point" "point from" [1 2 3])", {}},
          {"Spot", R"("spot" "float coneangle" 50 "float conedeltaangle" 30)", Tilted()},
          {"SharpSpot", R"("spot" "float coneangle" 120 "float conedeltaangle" 0)", Tilted()},
          {"SoftSpot", R"("spot" "float coneangle" 70 "float conedeltaangle" 70)", {}},
          {"Sky", R"("infinite")", {}},
          {"Map", WriteMap(12, 6), Tilted()},
          {"TinyMap", WriteMap(1, 3), Tilted()},
          {"StretchedMap", WriteMap(8, 5), Stretched()},
          {"Goniometric", WriteMap(9, 5, "goniometric"), Tilted()},
          {"GoniometricStretched", WriteMap(8, 5, "goniometric"), Stretched()},
          {"GoniometricUniform", "\"goniometric\"", Tilted()},
          {"Projection", WriteMap(9, 5, "projection") + " \"float fov\" 70", Tilted()},
          {"ProjectionHigh", WriteMap(3, 8, "projection") + " \"float fov\" 110", {}},
          {"ProjectionStretched", WriteMap(4, 4, "projection"), Stretched()},
          {"ProjectionSquare", "\"projection\" \"float fov\" 120", Tilted()}};
}

std::string NameOf(const testing::TestParamInfo<LightCase>& info) { return info.param.name; }

class PlainLight : public testing::TestWithParam<LightCase> {
 protected:
  PlainLight() : light_(plugins_.MakeLight(GetParam().text, GetParam().toWorld)) {
    light_->Prepare(kWorld);
  }
  std::optional<LightLeSample> Emit(RandomStream& random) const {
    const Point2 position{random.Uniform(), random.Uniform()};
    const Point2 direction{random.Uniform(), random.Uniform()};
    return light_->SampleEmission(position, direction, random.Uniform(), 0);
  }
  // Maps have edges, so the quadrature is finer.
  static ChiSquareOptions Options() { return {.quadratureDepth = 7}; }

  TestPlugins plugins_;
  std::unique_ptr<Light> light_;
};

TEST_P(PlainLight, EmitsDirectionsOfItsDensity) {
  const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
    const auto emission = Emit(random);
    if (!emission) return std::nullopt;
    const auto pdf = light_->PdfEmission({emission->ray.o, {}, {}}, emission->ray.d);
    EXPECT_NEAR(double(pdf.direction), double(emission->pdfDirection),
                1e-3 * double(emission->pdfDirection) + 1e-3);
    return emission->ray.d;
  };
  const auto pdf = [&](const Vector3& w) { return double(light_->PdfEmission({}, w).direction); };
  EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf, Options()), kLightTests));
}

TEST_P(PlainLight, EmitsItsPowerInTheMean) {
  const auto estimate = EstimateOverSeeds([&](std::uint64_t seed) {
    RandomStream random(seed);
    double sum = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i < kSamples; ++i)
      if (const auto emission = Emit(random)) sum += double(emission->power.g);
    return sum / kSamples;
  });
  // The power of a sky's map is an estimate: it weights the mean of each cell by the cell's solid
  // angle, and it ignores a stretch of the light's transformation. The tolerance of the lights at a
  // point with a map allows for the noise of the samples.
  const std::string& text = GetParam().text;
  const bool isMap = text.find("mapname") != std::string::npos;
  const bool isAtPoint = text.starts_with("\"goniometric\"") || text.starts_with("\"projection\"");
  const double tolerance = isAtPoint                              ? .015
                           : !isMap                               ? .001
                           : GetParam().toWorld.SimilarityScale() ? .2
                                                                  : .5;
  EXPECT_TRUE(IsWithin(tolerance, estimate, double(light_->Power().g)));
}

// The bound must hold, and must be near the largest power of a photon. A stretched map has none.
TEST_P(PlainLight, EmitsWithinItsBound) {
  const auto bound = light_->EmissionBound();
  const bool isMap = GetParam().text.find("mapname") != std::string::npos;
  ASSERT_EQ(bound.has_value(), !isMap || GetParam().toWorld.SimilarityScale().has_value());
  if (!bound) return;
  RandomStream random(11);
  Real largest = 0;
  for (int i = 0; i < 100000; ++i)
    if (const auto emission = Emit(random)) largest = std::max(largest, emission->power.Y());
  EXPECT_LE(largest, *bound * Real(1.001));
  const bool isPlain = !isMap && !GetParam().text.starts_with("\"projection\"");
  EXPECT_GE(largest, *bound * (isPlain ? Real(.999) : Real(.5)));
}

INSTANTIATE_TEST_SUITE_P(Lights, PlainLight, testing::ValuesIn(PlainLights()), NameOf);

class SkyLight : public PlainLight {};

TEST_P(SkyLight, IsSampledFromAPointByItsDensity) {
  const SurfacePoint ref{{1, 2, 3}, {}, {0, 1, 0}};
  const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
    const auto direct =
        light_->SampleDirect(ref, {random.Uniform(), random.Uniform()}, random.Uniform());
    if (!direct) return std::nullopt;
    EXPECT_EQ(direct->pdf, light_->PdfDirect(ref, direct->wi, nullptr));
    EXPECT_EQ(direct->Li, light_->Le(direct->wi));
    return direct->wi;
  };
  const auto pdf = [&](const Vector3& w) { return double(light_->PdfDirect(ref, w, nullptr)); };
  EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf, Options()), kLightTests));
}

// Every direction with radiance must have a positive density. Otherwise light would be missing.
TEST_P(SkyLight, HasDensityWhereverItShines) {
  RandomStream random(7);
  for (int i = 0; i < 20000; ++i) {
    const Vector3 w = SampleUniformSphere({random.Uniform(), random.Uniform()});
    if (!light_->Le(w).IsBlack()) {
      EXPECT_GT(light_->PdfDirect({}, w, nullptr), 0);
    }
  }
}

// Projected to a plane through the world's centre, the origins of the rays must fill the disk of
// the world's bounding sphere evenly.
TEST_P(SkyLight, EmitsFromADiskThatCoversTheWorld) {
  const auto sample = [&](RandomStream& random) -> std::optional<Point2> {
    const auto emission = Emit(random);
    if (!emission) return std::nullopt;
    const Vector3 fromCentre = emission->ray.o - kWorld.center;
    EXPECT_GE(Length(fromCentre), kWorld.radius);
    const Frame frame = Frame::FromZ(emission->ray.d);
    // Radius squared and angle map a uniform disk to a uniform rectangle.
    const Real x = Dot(fromCentre, frame.x), y = Dot(fromCentre, frame.y);
    return Point2{(x * x + y * y) / Square(kWorld.radius), std::atan2(y, x)};
  };
  const PlaneGrid grid{{0, -kPi}, {Real(1.00001), kPi}};
  EXPECT_TRUE(FitsDensity(
      TestPlane(grid, sample, [](Point2 p) { return p.x <= 1 ? .5 / M_PI : 0; }), kLightTests));
}

std::vector<LightCase> Skies() {
  auto lights = PlainLights();
  return {lights.begin() + 4, lights.begin() + 8};
}
INSTANTIATE_TEST_SUITE_P(Lights, SkyLight, testing::ValuesIn(Skies()), NameOf);

TEST(AreaLight, KnowsABoundUnlessItIsScaledUnevenly) {
  TestPlugins plugins;
  for (const char* shape : {R"("sphere")", R"("cylinder")", R"("cone")", R"("disk")",
                            R"("paraboloid")", R"("hyperboloid")"}) {
    const auto even = plugins.MakeAreaLight(R"("area")", plugins.MakeEmitter(shape, Tilted()));
    ASSERT_TRUE(even->EmissionBound()) << shape;
    EXPECT_EQ(*even->EmissionBound(), even->Power().Y());
    if (std::string(shape) == R"("disk")") continue;  // stays uniform
    const auto uneven = plugins.MakeAreaLight(R"("area")", plugins.MakeEmitter(shape, Stretched()));
    EXPECT_FALSE(uneven->EmissionBound()) << shape;
  }
}

TEST(AreaLight, EmitsByTheCosineFromItsWholeSurface) {
  TestPlugins plugins;
  const auto surface = plugins.MakeEmitter(R"("disk" "float radius" 2)", Tilted());
  const auto light = plugins.MakeAreaLight(R"("area")", surface);
  const SurfacePoint on = surface->SamplePoint({Real(.5), Real(.5)}, Real(.5), 0).point;
  const auto sample = [&](RandomStream& random) -> std::optional<Vector3> {
    const auto emission =
        light->SampleEmission({random.Uniform(), random.Uniform()},
                              {random.Uniform(), random.Uniform()}, random.Uniform(), 0);
    EXPECT_GT(Dot(emission->ray.d, on.ng), 0);
    EXPECT_NEAR(double(Dot(emission->ray.o - on.p, on.ng)), 0, 1e-6);
    return emission->ray.d;
  };
  const auto pdf = [&](const Vector3& w) { return double(light->PdfEmission(on, w).direction); };
  EXPECT_TRUE(FitsDensity(TestDirections({}, sample, pdf), kLightTests));
  EXPECT_NEAR(double(light->PdfEmission(on, on.ng).position), 1 / (4 * M_PI), 1e-6);
}

}  // namespace
}  // namespace exphoton
