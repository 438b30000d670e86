// SPDX-License-Identifier: BSD-2-Clause
// These tests compare textures with formulas in double: coordinates of every mapping under a
// transformation, blends of varying textures, filtered checkerboards, and every parameter of image
// maps.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/imaging/files/exr.h"
#include "core/imaging/mipmap.h"
#include "core/math/sampling/random.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

Transform Placed() {
  return Transform::Translate({1, 2, 3}) * *Transform::Rotate(50, {1, 3, 1}) *
         *Transform::Scale(2, 2, 2);
}

SurfaceInteraction RandomPoint(RandomStream& random) {
  const auto between = [&] { return 6 * random.Uniform() - 3; };
  SurfaceInteraction si = FlatSurface();
  si.hasDifferentials = true;
  si.p = {between(), between(), between()};
  si.uv = {between(), between()};
  si.dpdx = {between(), between(), between()};
  si.dpdy = {between(), between(), between()};
  si.dudx = between(), si.dvdx = between(), si.dudy = between(), si.dvdy = between();
  return si;
}

struct St {
  double s, t;
};

double Fraction(double x) { return x - std::floor(x); }

// "uv" shows the fractions of a mapping's coordinates.
void ExpectCoordinates(const std::string& parameters, St (*expected)(const SurfaceInteraction&)) {
  TestPlugins plugins;
  const auto texture = plugins.MakeColorTexture("\"uv\" " + parameters, Placed());
  RandomStream random(3);
  for (int i = 0; i < 100; ++i) {
    const SurfaceInteraction si = RandomPoint(random);
    const St st = expected(si);
    const double s = Fraction(st.s), t = Fraction(st.t);
    if (std::min({s, t, 1 - s, 1 - t}) < 1e-3) continue;  // a seam
    const Spectrum color = texture->Evaluate(si);
    EXPECT_NEAR(double(color.r), s, 2e-5) << parameters;
    EXPECT_NEAR(double(color.g), t, 2e-5) << parameters;
    EXPECT_EQ(color.b, 0);
  }
}

// The point in the texture's space as a unit vector.
Vector3 UnitInTexture(const SurfaceInteraction& si) {
  return Normalize(Placed().Inverted().ApplyPoint(si.p) - Point3());
}

TEST(TextureCoordinates, OfUvAreScaledAndShifted) {
  ExpectCoordinates(R"("float uscale" .3 "float vscale" -.2 "float udelta" .15 "float vdelta" .4)",
                    [](const SurfaceInteraction& si) -> St {
                      return {.3 * double(si.uv.x) + .15, -.2 * double(si.uv.y) + .4};
                    });
  ExpectCoordinates("", [](const SurfaceInteraction& si) -> St {
    return {double(si.uv.x), double(si.uv.y)};
  });
}

// Planar coordinates are products with the point in the world.
TEST(TextureCoordinates, OfPlanesAreProductsWithTheirVectors) {
  ExpectCoordinates(
      R"("string mapping" "planar" "vector v1" [.1 .2 -.3] "vector v2" [-.2 .1 .4]
         "float udelta" .15 "float vdelta" .4 "float uscale" 7 "float vscale" 5)",
      [](const SurfaceInteraction& si) -> St {
        const double x = double(si.p.x), y = double(si.p.y), z = double(si.p.z);
        return {.1 * x + .2 * y - .3 * z + .15, -.2 * x + .1 * y + .4 * z + .4};
      });
  ExpectCoordinates(R"("string mapping" "planar")", [](const SurfaceInteraction& si) -> St {
    return {double(si.p.x), double(si.p.y)};
  });
}

TEST(TextureCoordinates, OfSpheresAreThePolarAngles) {
  ExpectCoordinates(R"("string mapping" "spherical")", [](const SurfaceInteraction& si) -> St {
    const Vector3 unit = UnitInTexture(si);
    return {std::acos(double(unit.z)) / M_PI,
            std::atan2(double(unit.y), double(unit.x)) / (2 * M_PI)};
  });
}

TEST(TextureCoordinates, OfCylindersAreAzimuthAndHeight) {
  ExpectCoordinates(R"("string mapping" "cylindrical")", [](const SurfaceInteraction& si) -> St {
    const Vector3 unit = UnitInTexture(si);
    return {.5 + std::atan2(double(unit.y), double(unit.x)) / (2 * M_PI), double(unit.z)};
  });
}

class TextureValues : public testing::Test {
 protected:
  // "u" is the float u; "colors" varies in both coordinates; both are not filtered.
  TextureValues() {
    plugins_.Define("u", TexturePtr<Real>(Float(R"("bilerp" "float v01" 0 "float v10" 1)")));
    plugins_.Define("v", TexturePtr<Real>(Float(R"("bilerp")")));
    plugins_.Define("filtered", TexturePtr<Real>(Float(R"("checkerboard")")));
    plugins_.Define("two", TexturePtr<Real>(Float(R"("constant" "float value" 2)")));
  }
  std::shared_ptr<FloatTexture> Float(const std::string& text) {
    return plugins_.MakeFloatTexture(text, Placed());
  }
  std::shared_ptr<ColorTexture> Color(const std::string& text) {
    return plugins_.MakeColorTexture(text, Placed());
  }
  TestPlugins plugins_;
};

TEST_F(TextureValues, OfBilerpAreBilinearAlsoOutsideTheSquare) {
  const auto t = Color(
      R"("bilerp" "color v00" [1 2 3] "color v01" [4 6 5] "color v10" [9 7 8] "color v11" [0 3 6])");
  const double corners[4][3] = {{1, 2, 3}, {4, 6, 5}, {9, 7, 8}, {0, 3, 6}};
  RandomStream random(5);
  for (int i = 0; i < 50; ++i) {
    const SurfaceInteraction si = RandomPoint(random);
    const double s = double(si.uv.x), r = double(si.uv.y);
    for (int c = 0; c < 3; ++c) {
      const double truth = (1 - s) * (1 - r) * corners[0][c] + (1 - s) * r * corners[1][c] +
                           s * (1 - r) * corners[2][c] + s * r * corners[3][c];
      EXPECT_NEAR(double(t->Evaluate(si)[c]), truth, 1e-4);
    }
  }
  EXPECT_FALSE(t->ConstantValue());
  for (const char* corner : {"v00", "v01", "v10", "v11"}) {
    std::string text = "\"bilerp\"";
    for (const char* name : {"v00", "v01", "v10", "v11"})
      text += std::string(" \"float ") + name + "\" " + (name == std::string(corner) ? "3" : "2");
    EXPECT_FALSE(Float(text)->ConstantValue()) << corner;
  }
  EXPECT_EQ(Float(R"("bilerp" "float v00" 1 "float v10" 1)")->ConstantValue(), Real(1));
  // Without parameters: 0 at t = 0, 1 at t = 1.
  const SurfaceInteraction si = RandomPoint(random);
  EXPECT_NEAR(double(Float("\"bilerp\"")->Evaluate(si)), double(si.uv.y), 1e-5);
}

TEST_F(TextureValues, OfMixAndScaleFollowTheirTextures) {
  RandomStream random(6);
  const auto mix = Float(R"("mix" "texture tex1" "u" "texture tex2" "two" "texture amount" "v")");
  const auto plain = Float(R"("mix" "texture amount" "v")");
  const auto half = Float(R"("mix" "texture tex1" "u" "texture tex2" "two")");
  const auto scale = Float(R"("scale" "texture tex1" "u" "texture tex2" "v")");
  for (int i = 0; i < 50; ++i) {
    const SurfaceInteraction si = RandomPoint(random);
    const double u = double(si.uv.x), v = double(si.uv.y);
    EXPECT_NEAR(double(mix->Evaluate(si)), (1 - v) * u + v * 2, 1e-4);
    EXPECT_NEAR(double(plain->Evaluate(si)), v, 1e-5);
    EXPECT_NEAR(double(half->Evaluate(si)), .5 * u + 1, 1e-5);
    EXPECT_NEAR(double(scale->Evaluate(si)), u * v, 1e-4);
  }
  EXPECT_EQ(Float("\"scale\"")->ConstantValue(), Real(1));
  EXPECT_EQ(Float("\"mix\"")->ConstantValue(), Real(.5));
}

// A blend is known while loading where the texture that varies does not count.
TEST_F(TextureValues, OfMixAreKnownWhereTheOtherDoesNotCount) {
  const auto constant = [&](const std::string& text) { return Float(text)->ConstantValue(); };
  EXPECT_EQ(constant(R"("mix" "float tex1" 3 "texture tex2" "u" "float amount" 0)"), Real(3));
  EXPECT_EQ(constant(R"("mix" "float tex2" 3 "texture tex1" "u" "float amount" 1)"), Real(3));
  EXPECT_FALSE(constant(R"("mix" "float tex2" 3 "texture tex1" "u" "float amount" 0)"));
  EXPECT_FALSE(constant(R"("mix" "float tex1" 3 "texture tex2" "u" "float amount" 1)"));
  EXPECT_FALSE(constant(R"("mix" "float tex1" 3 "texture tex2" "u" "float amount" .5)"));
  EXPECT_FALSE(constant(R"("mix" "float tex1" 3 "float tex2" 4 "texture amount" "u")"));
  EXPECT_EQ(constant(R"("mix" "float tex1" 4 "float tex2" 4 "texture amount" "u")"), Real(4));
  EXPECT_EQ(constant(R"("mix" "float tex1" 4 "float tex2" 8 "float amount" .25)"), Real(5));
  EXPECT_EQ(constant(R"("scale" "float tex1" 0 "texture tex2" "u")"), Real(0));
  EXPECT_EQ(constant(R"("scale" "float tex2" 0 "texture tex1" "u")"), Real(0));
  EXPECT_FALSE(constant(R"("scale" "float tex1" 2 "texture tex2" "u")"));
  EXPECT_EQ(constant(R"("checkerboard" "float tex1" 2 "float tex2" 2)"), Real(2));
  EXPECT_FALSE(constant(R"("checkerboard" "float tex1" 2 "float tex2" 3)"));
}

TEST_F(TextureValues, AreFilteredWhereAPartIs) {
  for (const char* part : {"tex1", "tex2", "amount"})
    EXPECT_TRUE(Float(std::string("\"mix\" \"texture ") + part + "\" \"filtered\"")->IsFiltered());
  EXPECT_FALSE(Float(R"("mix" "texture amount" "u")")->IsFiltered());
  for (const char* part : {"tex1", "tex2"}) {
    const std::string checker =
        std::string("\"checkerboard\" \"string aamode\" \"none\" \"texture ") + part + "\" ";
    EXPECT_TRUE(Float(checker + "\"filtered\"")->IsFiltered());
    EXPECT_FALSE(Float(checker + "\"u\"")->IsFiltered());
  }
  EXPECT_TRUE(Float(R"("checkerboard" "string aamode" "supersample")")->IsFiltered());
}

double Odd(double x) { return std::fmod(std::floor(x), 2) == 0 ? 0 : 1; }

// In space the cells are those of the texture's space, and the default colours are 1 and 0.
TEST_F(TextureValues, OfCubesAreThoseOfTheTexturesSpace) {
  const auto t = Float(
      R"("checkerboard" "integer dimension" 3 "string aamode" "none" "float tex1" 3 "float tex2" 7)");
  const auto plain = Float(R"("checkerboard" "integer dimension" 3 "string aamode" "none")");
  RandomStream random(7);
  for (int i = 0; i < 200; ++i) {
    const SurfaceInteraction si = RandomPoint(random);
    const Point3 p = Placed().Inverted().ApplyPoint(si.p);
    const bool isOdd = Odd(Odd(double(p.x)) + Odd(double(p.y)) + Odd(double(p.z))) != 0;
    EXPECT_EQ(t->Evaluate(si), isOdd ? 7 : 3);
    EXPECT_EQ(plain->Evaluate(si), isOdd ? 0 : 1);
  }
}

// The mean over a box: the integral of the parity, by many points along each axis.
double OddShare(double x, double radius) {
  constexpr int kSteps = 4000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += Odd(x + radius * ((2 * i + 1.) / kSteps - 1)) / kSteps;
  return sum;
}

TEST_F(TextureValues, OfFilteredCubesAreMeansOverTheFootprintsBox) {
  const auto t = Float(R"("checkerboard" "integer dimension" 3 "float tex1" 3 "float tex2" 7)");
  RandomStream random(8);
  for (int i = 0; i < 30; ++i) {
    SurfaceInteraction si = RandomPoint(random);
    si.dpdx = si.dpdx * Real(.5), si.dpdy = si.dpdy * Real(.5);
    const Transform toTexture = Placed().Inverted();
    const Point3 p = toTexture.ApplyPoint(si.p);
    const Vector3 dx = toTexture.ApplyVector(si.dpdx), dy = toTexture.ApplyVector(si.dpdy);
    double even = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double radius = std::max(std::abs(double(dx[axis])), std::abs(double(dy[axis])));
      even *= 1 - 2 * OddShare(double(p[axis]), radius);
    }
    EXPECT_NEAR(double(t->Evaluate(si)), 3 + 4 * (1 - even) / 2, .02);
  }
}

// Supersampling: 4 x 4 points of the square from -1 to 1 pixels, with the weight exp(-2 r^2).
TEST_F(TextureValues, OfSupersampledSquaresAreWeightedSums) {
  const auto t = Float(R"("checkerboard" "string aamode" "supersample" "float uscale" .5)");
  RandomStream random(9);
  for (int i = 0; i < 50; ++i) {
    SurfaceInteraction si = RandomPoint(random);
    double sum = 0, weights = 0;
    for (const double y : {-.75, -.25, .25, .75}) {
      for (const double x : {-.75, -.25, .25, .75}) {
        const double s = .5 * (double(si.uv.x) + x * double(si.dudx) + y * double(si.dudy));
        const double r = double(si.uv.y) + x * double(si.dvdx) + y * double(si.dvdy);
        const double weight = std::exp(-2 * (x * x + y * y));
        weights += weight;
        sum += weight * Odd(Odd(s) + Odd(r));
      }
    }
    EXPECT_NEAR(double(t->Evaluate(si)), 1 - sum / weights, 1e-4);
  }
}

class ImageMaps : public TextureValues {
 protected:
  ImageMaps()
      : file_((std::filesystem::temp_directory_path() /
               ("exphoton_texture_values_" + std::to_string(getpid()) + ".exr"))
                  .string()) {
    Image image(8, 4, {"R", "G", "B"});
    RandomStream random(10);
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 8; ++x) {
        for (int c = 0; c < 3; ++c) image.At(x, y, c) = float(random.Uniform());
        texels_.push_back(Spectrum(image.At(x, y, 0), image.At(x, y, 1), image.At(x, y, 2)));
      }
    WriteExr(file_, image, false);
  }
  ~ImageMaps() override { std::filesystem::remove(file_); }
  MipMap<Spectrum> Map(WrapMode wrap) const { return {8, 4, texels_, wrap}; }
  std::shared_ptr<ColorTexture> Image8(const std::string& parameters) {
    return Color("\"imagemap\" \"string filename\" \"" + file_ + "\" " + parameters);
  }
  std::string file_;
  std::vector<Spectrum> texels_;
};

// Every parameter reaches the filter.
TEST_F(ImageMaps, AreFilteredAsTheirParametersSay) {
  const auto plain = Image8(""), narrow = Image8(R"("float maxanisotropy" 2)");
  const auto trilinear = Image8(R"("bool trilinear" "true")");
  const auto black = Image8(R"("string wrap" "black")"), clamp = Image8(R"("string wrap" "clamp")");
  const auto repeat = Image8(R"("string wrap" "repeat")");
  const auto scaled = Image8(R"("float uscale" 2 "float vscale" .5 "float udelta" .1)");
  const MipMap<Spectrum> map = Map(WrapMode::Repeat);
  RandomStream random(11);
  int differ = 0;
  for (int i = 0; i < 50; ++i) {
    SurfaceInteraction si = RandomPoint(random);
    si.dudx *= Real(.05), si.dvdx *= Real(.01), si.dudy *= Real(.01), si.dvdy *= Real(.05);
    const Point2 dx(si.dudx, si.dvdx), dy(si.dudy, si.dvdy);
    EXPECT_EQ(plain->Evaluate(si), map.Ewa(si.uv, dx, dy, 8));
    EXPECT_EQ(repeat->Evaluate(si), plain->Evaluate(si));
    EXPECT_EQ(narrow->Evaluate(si), map.Ewa(si.uv, dx, dy, 2));
    differ += !(narrow->Evaluate(si) == plain->Evaluate(si));
    EXPECT_EQ(trilinear->Evaluate(si), map.Trilinear(si.uv, dx, dy));
    EXPECT_EQ(black->Evaluate(si), Map(WrapMode::Black).Ewa(si.uv, dx, dy, 8));
    EXPECT_EQ(clamp->Evaluate(si), Map(WrapMode::Clamp).Ewa(si.uv, dx, dy, 8));
    const Point2 st(2 * si.uv.x + Real(.1), Real(.5) * si.uv.y);
    EXPECT_EQ(scaled->Evaluate(si), map.Ewa(st, {2 * dx.x, dx.y / 2}, {2 * dy.x, dy.y / 2}, 8));
  }
  EXPECT_GT(differ, 10);
}

}  // namespace
}  // namespace exphoton
