// SPDX-License-Identifier: BSD-2-Clause
// These tests check textures through their plugins: values, means under filtering, mappings and
// their footprints.
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "core/base/error.h"
#include "core/imaging/files/exr.h"
#include "core/imaging/files/png.h"
#include "core/math/sampling/random.h"
#include "core/scattering/texture_mapping.h"
#include "gtest/gtest.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

SurfaceInteraction At(Real u, Real v) {
  SurfaceInteraction si = FlatSurface();
  si.uv = {u, v};
  si.p = {u, v, 0};
  return si;
}
SurfaceInteraction WithFootprint(Real u, Real v, Real dudx, Real dvdy) {
  SurfaceInteraction si = At(u, v);
  si.hasDifferentials = true;
  si.dudx = dudx;
  si.dvdy = dvdy;
  si.dpdx = {dudx, 0, 0};
  si.dpdy = {0, dvdy, 0};
  return si;
}

class Textures : public testing::Test {
 protected:
  std::shared_ptr<FloatTexture> Float(const std::string& text) {
    return plugins_.MakeFloatTexture(text);
  }
  std::shared_ptr<ColorTexture> Color(const std::string& text) {
    return plugins_.MakeColorTexture(text);
  }
  TestPlugins plugins_;
};

TEST_F(Textures, ConstantIsKnownWhileLoading) {
  EXPECT_EQ(Float(R"("constant" "float value" .25)")->ConstantValue(), Real(.25));
  EXPECT_EQ(Color(R"("constant" "color value" [1 2 3])")->ConstantValue(), Spectrum(1, 2, 3));
  EXPECT_EQ(Float(R"("constant")")->ConstantValue(), Real(1));
  EXPECT_TRUE(Float(R"("constant" "float value" 0)")->IsProvablyZero());
}

TEST_F(Textures, ScaleMultiplies) {
  plugins_.Define("a", TexturePtr<Real>(Float(R"("bilerp")")));
  const auto scaled = Float(R"("scale" "texture tex1" "a" "float tex2" 4)");
  EXPECT_FLOAT_EQ(float(scaled->Evaluate(At(Real(.3), Real(.5)))), 2.f);
  EXPECT_FALSE(scaled->ConstantValue());
  EXPECT_TRUE(Float(R"("scale" "texture tex1" "a" "float tex2" 0)")->IsProvablyZero());
  EXPECT_EQ(Float(R"("scale" "float tex1" 3 "float tex2" .5)")->ConstantValue(), Real(1.5));
}

TEST_F(Textures, ScaleIsFilteredWhereEitherFactorIs) {
  plugins_.Define("filtered", TexturePtr<Real>(Float(R"("checkerboard")")));
  EXPECT_TRUE(Float(R"("scale" "texture tex1" "filtered")")->IsFiltered());
  EXPECT_TRUE(Float(R"("scale" "texture tex2" "filtered")")->IsFiltered());
  EXPECT_FALSE(Float(R"("scale")")->IsFiltered());
}

TEST_F(Textures, MixGoesFromOneToTheOther) {
  EXPECT_EQ(Color(R"("mix" "color tex1" [0 0 0] "color tex2" [2 4 8] "float amount" .25)")
                ->ConstantValue(),
            Spectrum(Real(.5), 1, 2));
  EXPECT_EQ(Float(R"("mix")")->Evaluate(At(0, 0)), Real(.5));
}

TEST_F(Textures, BilerpHasItsCornersValues) {
  const auto t = Float(R"("bilerp" "float v00" 1 "float v01" 2 "float v10" 3 "float v11" 5)");
  EXPECT_EQ(t->Evaluate(At(0, 0)), 1);
  EXPECT_EQ(t->Evaluate(At(0, 1)), 2);
  EXPECT_EQ(t->Evaluate(At(1, 0)), 3);
  EXPECT_EQ(t->Evaluate(At(1, 1)), 5);
  EXPECT_FLOAT_EQ(float(t->Evaluate(At(Real(.5), Real(.5)))), 2.75f);
}

TEST_F(Textures, UvShowsFractions) {
  const Spectrum c =
      Color(R"("uv" "float uscale" 2 "float vdelta" -.5)")->Evaluate(At(Real(.75), Real(.25)));
  EXPECT_FLOAT_EQ(float(c.r), .5f);
  EXPECT_FLOAT_EQ(float(c.g), .75f);
  EXPECT_EQ(c.b, 0);
  EXPECT_THROW(Float(R"("uv")"), Error);
}

TEST_F(Textures, CheckerboardAlternates) {
  const auto t = Float(R"("checkerboard" "string aamode" "none")");
  EXPECT_EQ(t->Evaluate(At(Real(.5), Real(.5))), 1);
  EXPECT_EQ(t->Evaluate(At(Real(1.5), Real(.5))), 0);
  EXPECT_EQ(t->Evaluate(At(Real(-.5), Real(.5))), 0);
  EXPECT_EQ(t->Evaluate(At(Real(-.5), Real(-1.5))), 0);
  EXPECT_EQ(t->Evaluate(At(Real(-.5), Real(-.5))), 1);
  EXPECT_FALSE(t->IsFiltered());
}

TEST_F(Textures, CheckerboardInSpaceAlternatesAlongEveryAxis) {
  const auto t = Float(R"("checkerboard" "integer dimension" 3)");
  SurfaceInteraction si = At(Real(.5), Real(.5));
  si.p.z = Real(.5);
  EXPECT_EQ(t->Evaluate(si), 1);
  si.p.z = Real(1.5);
  EXPECT_EQ(t->Evaluate(si), 0);
  EXPECT_THROW(Float(R"("checkerboard" "integer dimension" 4)"), Error);
}

TEST_F(Textures, FilteredCheckerboardIsTheMeanOverItsBox) {
  const auto t = Float(R"("checkerboard")");
  EXPECT_TRUE(t->IsFiltered());
  // Half of the box [.5, 1.5] x [.4, .6] lies in each cell. With [.75, 1.05], a sixth lies in
  // the odd cell.
  EXPECT_NEAR(t->Evaluate(WithFootprint(1, Real(.5), Real(.5), Real(.1))), .5, 1e-6);
  EXPECT_NEAR(t->Evaluate(WithFootprint(Real(.9), Real(.5), Real(.15), Real(.1))), 5. / 6, 1e-6);
  // The filtered values are compared with point samples, over boxes of every size and position.
  const auto points = Float(R"("checkerboard" "string aamode" "none")");
  RandomStream random(1);
  for (int i = 0; i < 20; ++i) {
    const Real u = 6 * random.Uniform() - 3, v = 6 * random.Uniform() - 3;
    const Real du = 2 * random.Uniform(), dv = 2 * random.Uniform();
    double sum = 0;
    const int n = 100;
    for (int k = 0; k < n * n; ++k) {
      const Real x = u + du * (2 * (Real(k % n) + Real(.5)) / n - 1);
      const Real y = v + dv * (2 * (Real(k / n) + Real(.5)) / n - 1);
      sum += double(points->Evaluate(At(x, y)));
    }
    EXPECT_NEAR(t->Evaluate(WithFootprint(u, v, du, dv)), sum / (n * n), .02);
  }
}

TEST_F(Textures, SupersampledCheckerboardGoesToTheMean) {
  const auto t = Float(R"("checkerboard" "string aamode" "supersample")");
  EXPECT_EQ(t->Evaluate(At(Real(.5), Real(.5))), 1);
  EXPECT_NEAR(t->Evaluate(WithFootprint(1, Real(.5), Real(.4), Real(.1))), .5, 1e-6);
}

TEST_F(Textures, HugeFootprintsOfACheckerboardAreGrey) {
  for (const char* dimension : {"2", "3"}) {
    const auto t = Float(R"("checkerboard" "integer dimension" )" + std::string(dimension));
    EXPECT_NEAR(t->Evaluate(WithFootprint(Real(.3), Real(.4), 1000, 1000)), .5, 1e-3);
  }
}

// The derivatives of every mapping must match differences of its coordinates.
TEST(TextureMapping, DerivativesAreThoseOfTheCoordinates) {
  using Kind = TextureMapping2D::Kind;
  const Transform toWorld = Transform::Translate({1, 2, 3}) * *Transform::Rotate(30, {1, 1, 0}) *
                            *Transform::Scale(2, 2, 2);
  RandomStream random(1);
  for (Kind kind : {Kind::Uv, Kind::Spherical, Kind::Cylindrical, Kind::Planar}) {
    TextureMapping2D::Options options;
    options.kind = kind;
    options.uScale = 3, options.vScale = Real(.5);
    options.v1 = {Real(.3), 1, 0}, options.v2 = {0, Real(.2), Real(.7)};
    const TextureMapping2D mapping(options, toWorld);
    for (int i = 0; i < 50; ++i) {
      SurfaceInteraction si = FlatSurface();
      si.hasDifferentials = true;
      si.p = {4 * random.Uniform(), 5 * random.Uniform(), 6 * random.Uniform()};
      si.uv = {random.Uniform(), random.Uniform()};
      si.dpdx = {random.Uniform(), random.Uniform(), random.Uniform()};
      si.dpdy = {random.Uniform(), random.Uniform(), random.Uniform()};
      si.dudx = random.Uniform(), si.dvdx = random.Uniform();
      si.dudy = random.Uniform(), si.dvdy = random.Uniform();
      const TexturePoint2 here = mapping.Map(si);
      const auto check = [&](const Vector3& dp, Point2 duv, Point2 derivative) {
        const Real step = Real(1e-2);
        SurfaceInteraction next = si;
        next.p = si.p + dp * step;
        next.uv = si.uv + duv * step;
        const Point2 change = (mapping.Map(next).st - here.st) * (1 / step);
        const bool isCurved = kind == Kind::Spherical || kind == Kind::Cylindrical;
        // The test skips seams and changes near half a turn, because a footprint is limited
        // to half a turn.
        if (isCurved && std::max(std::abs(change.x), std::abs(change.y)) > Real(.45)) return;
        const double tolerance = isCurved ? .03 : 2e-3;
        EXPECT_NEAR(derivative.x, change.x, tolerance) << int(kind);
        EXPECT_NEAR(derivative.y, change.y, tolerance) << int(kind);
      };
      check(si.dpdx, {si.dudx, si.dvdx}, here.dstdx);
      check(si.dpdy, {si.dudy, si.dvdy}, here.dstdy);
    }
  }
}

TEST(TextureMapping, UvAndPlanarCoordinatesAreScaledAndShifted) {
  TextureMapping2D::Options options;
  options.uScale = 3, options.vScale = Real(.5);
  options.uDelta = Real(.25), options.vDelta = -2;
  options.v1 = {1, 2, 0}, options.v2 = {0, 1, -1};
  SurfaceInteraction si = FlatSurface();
  si.uv = {Real(.5), 4};
  si.p = {1, 2, 5};
  EXPECT_EQ(TextureMapping2D(options, {}).Map(si).st, Point2(Real(1.75), 0));
  options.kind = TextureMapping2D::Kind::Planar;
  EXPECT_EQ(TextureMapping2D(options, {}).Map(si).st, Point2(Real(5.25), -5));
}

TEST(TextureMapping, StaysFiniteAtPolesAndCentres) {
  using Kind = TextureMapping2D::Kind;
  for (Kind kind : {Kind::Spherical, Kind::Cylindrical}) {
    TextureMapping2D::Options options;
    options.kind = kind;
    const TextureMapping2D mapping(options, {});
    for (const Point3& p : {Point3(0, 0, 1), Point3(0, 0, -1), Point3(0, 0, 0), Point3(-1, 0, 0)}) {
      SurfaceInteraction si = FlatSurface();
      si.hasDifferentials = true;
      si.p = p;
      si.dpdx = {1, 0, 0};
      si.dpdy = {0, 1, 0};
      const TexturePoint2 at = mapping.Map(si);
      for (Point2 value : {at.st, at.dstdx, at.dstdy})
        EXPECT_TRUE(std::isfinite(value.x) && std::isfinite(value.y));
    }
  }
}

class ImageTextures : public Textures {
 protected:
  ImageTextures()
      : folder_(std::filesystem::temp_directory_path() /
                ("exphoton_texture_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ImageTextures() override { std::filesystem::remove_all(folder_); }
  std::string File(const std::string& name) const { return (folder_ / name).string(); }
  std::string Quoted(const std::string& name) const {
    return R"("imagemap" "string filename" ")" + File(name) + "\" ";
  }

 private:
  std::filesystem::path folder_;
};

// Returns a 2 x 2 image: red and green above blue and white.
Image FourColors() {
  Image image(2, 2, {"R", "G", "B"});
  image.At(0, 0, 0) = 1;
  image.At(1, 0, 1) = 1;
  image.At(0, 1, 2) = 1;
  for (int c = 0; c < 3; ++c) image.At(1, 1, c) = 1;
  return image;
}

TEST_F(ImageTextures, ReadExrAndPngTopRowFirst) {
  WriteExr(File("a.exr"), FourColors(), false);
  WritePng(File("a.png"), FourColors());
  for (const char* name : {"a.exr", "a.png"}) {
    const auto t = Color(Quoted(name));
    EXPECT_TRUE(t->IsFiltered());
    EXPECT_EQ(t->Evaluate(At(Real(.25), Real(.25))), Spectrum(1, 0, 0)) << name;
    EXPECT_EQ(t->Evaluate(At(Real(.75), Real(.25))), Spectrum(0, 1, 0)) << name;
    EXPECT_EQ(t->Evaluate(At(Real(.25), Real(.75))), Spectrum(0, 0, 1)) << name;
  }
}

TEST_F(ImageTextures, OfFloatsAreLuminance) {
  WriteExr(File("a.exr"), FourColors(), false);
  const auto t = Float(Quoted("a.exr"));
  EXPECT_NEAR(t->Evaluate(At(Real(.75), Real(.25))), .715160, 1e-6);
  EXPECT_NEAR(t->Evaluate(At(Real(.75), Real(.75))), 1, 1e-6);
}

TEST_F(ImageTextures, UnderAHugeFootprintAreTheirMean) {
  WriteExr(File("a.exr"), FourColors(), false);
  for (const char* trilinear : {"true", "false"}) {
    const auto t = Color(Quoted("a.exr") + R"("bool trilinear" ")" + trilinear + "\"");
    const Spectrum mean = t->Evaluate(WithFootprint(Real(.3), Real(.6), 50, 50));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], .5, 1e-5);
  }
}

TEST_F(ImageTextures, CountPixelsThatAreNoNumberAsZeroAndWarn) {
  Image image = FourColors();
  image.At(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  WriteExr(File("nan.exr"), image, false);
  const auto t = Color(Quoted("nan.exr"));
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
  EXPECT_EQ(t->Evaluate(At(Real(.25), Real(.25))), Spectrum());
}

TEST_F(ImageTextures, OfOneFileReadItOnce) {
  WriteExr(File("a.exr"), FourColors(), false);
  auto first = Color(Quoted("a.exr"));
  std::filesystem::remove(File("a.exr"));
  const auto second = Color(Quoted("a.exr") + R"("float maxanisotropy" 2)");
  EXPECT_EQ(second->Evaluate(At(Real(.25), Real(.25))), Spectrum(1, 0, 0));
  // Settings that change the pixels must not share the pixels of the loaded file.
  EXPECT_THROW(Color(Quoted("a.exr") + R"("string wrap" "clamp")"), Error);
  EXPECT_THROW(Float(Quoted("a.exr")), Error);
}

TEST_F(ImageTextures, AreForgottenWhenNothingShowsThem) {
  WriteExr(File("a.exr"), FourColors(), false);
  Color(Quoted("a.exr"));
  std::filesystem::remove(File("a.exr"));
  EXPECT_THROW(Color(Quoted("a.exr")), Error);
}

TEST_F(ImageTextures, ThatCannotBeReadAreErrors) {
  EXPECT_THROW(Color(Quoted("missing.exr")), Error);
  EXPECT_THROW(Color(R"("imagemap")"), Error);
  WriteExr(File("depth.exr"), Image(2, 2, {"Z"}), false);
  EXPECT_THROW(Color(Quoted("depth.exr")), Error);
  WriteExr(File("a.exr"), FourColors(), false);
  EXPECT_THROW(Color(Quoted("a.exr") + R"("string wrap" "mirror")"), Error);
  EXPECT_THROW(Color(Quoted("a.exr") + R"("float maxanisotropy" .5)"), Error);
}

}  // namespace
}  // namespace exphoton
