// SPDX-License-Identifier: BSD-2-Clause
// These tests check gradient noise by its stated properties, sums of octaves by an independent
// computation, and the textures that use them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"
#include "materials/textures/noise/noise.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

TEST(Noise, IsZeroAtIntegersSmoothAndPeriodic) {
  RandomStream random(1);
  const auto coordinate = [&] { return (double(random.Uniform()) - .5) * 600; };
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    EXPECT_EQ(Noise(std::floor(x), std::floor(y), std::floor(z)), 0);
    const double value = Noise(x, y, z);
    largest = std::max(largest, std::abs(value));
    EXPECT_NEAR(Noise(x + 256, y - 512, z + 256), value, 1e-10);
    // Across the face of a cell, value and slope continue.
    const double face = std::floor(x), e = 1e-5;
    EXPECT_NEAR(Noise(face - e, y, z) + Noise(face + e, y, z), 2 * Noise(face, y, z), 1e-8);
  }
  EXPECT_LE(largest, 1);
  EXPECT_GT(largest, .7);
}

// The mean is 0. The variance follows from the gradients, which have a mean square of 2/3 along
// each axis: three times the product of the integrals over an axis of the squared weights, one of
// them with the squared distance. The corners are independent.
TEST(Noise, HasTheMomentsOfItsGradients) {
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  double weight2 = 0, distance2 = 0;
  for (int i = 0; i < 1000; ++i) {
    const double t = (i + .5) / 1000, far = fade(t), near = 1 - far;
    weight2 += (near * near + far * far) / 1000;
    distance2 += (near * near * t * t + far * far * (1 - t) * (1 - t)) / 1000;
  }
  const double variance = 3 * (2. / 3) * distance2 * weight2 * weight2;
  RandomStream random(2);
  double sum = 0, sum2 = 0;
  constexpr int kSamples = 400000;
  for (int i = 0; i < kSamples; ++i) {
    const double value = Noise(256 * double(random.Uniform()), 256 * double(random.Uniform()),
                               256 * double(random.Uniform()));
    sum += value / kSamples, sum2 += value * value / kSamples;
  }
  EXPECT_NEAR(sum, 0, .003);
  EXPECT_NEAR(sum2 / variance, 1, .03);
}

// Perlin's permutation gives the corner (0, 0, 0) the hash 4, whose gradient is (1, 0, 1). Close to
// the corner, noise is the product of the gradient and the position.
TEST(Noise, HasPerlinsGradientAtTheOrigin) {
  const double e = 1e-4;
  EXPECT_NEAR(Noise(e, 0, 0) / e, 1, 1e-6);
  EXPECT_NEAR(Noise(0, e, 0) / e, 0, 1e-6);
  EXPECT_NEAR(Noise(0, 0, e) / e, 1, 1e-6);
}

TexturePoint3 At(const Point3& p, Real footprint) {
  return {p, Vector3(footprint, 0, 0), Vector3(0, footprint / 2, 0)};
}

TEST(Fbm, SumsOctavesDownToTheFootprint) {
  const Point3 p(Real(.3), Real(1.7), Real(-2.2));
  const auto octave = [&](int i) {
    const double f = std::pow(1.99, i);
    return Noise(f * double(p.x), f * double(p.y), f * double(p.z));
  };
  const auto sum = [&](double octaves, double roughness, bool isAbsolute) {
    double total = 0;
    const auto whole = int(octaves);
    const double t = std::clamp((octaves - whole - .3) / .4, 0., 1.);
    for (int i = 0; i <= whole; ++i) {
      const double value = isAbsolute ? std::abs(octave(i)) : octave(i);
      total += std::pow(roughness, i) * value * (i < whole ? 1 : t * t * (3 - 2 * t));
    }
    return total;
  };
  EXPECT_NEAR(FbmAt(At(p, 0), {5, .6}), sum(5, .6, false), 1e-12);
  EXPECT_NEAR(TurbulenceAt(At(p, 0), {5, .6}), sum(5, .6, true), 1e-12);
  // A footprint of 2^-3.5 leaves 1 + 3.5 octaves.
  const Real footprint = std::exp2(Real(-3.5));
  EXPECT_NEAR(FbmAt(At(p, footprint), {8, .5}), sum(4.5, .5, false), 1e-5);
  EXPECT_NEAR(TurbulenceAt(At(p, footprint), {8, .5}), sum(4.5, .5, true), 1e-5);
  EXPECT_EQ(FbmAt(At(p, footprint), {3, .5}), FbmAt(At(p, 0), {3, .5}));
  EXPECT_EQ(FbmAt(At(p, 100), {8, .5}), 0);
  EXPECT_EQ(FbmAt(At(p, 0), {0, .5}), 0);
}

class NoiseTextures : public testing::Test {
 protected:
  static SurfaceInteraction Surface(const Point3& p) {
    SurfaceInteraction si = FlatSurface();
    si.p = p;
    si.uv = {p.x, p.y};
    return si;
  }
  TestPlugins plugins_;
};

TEST_F(NoiseTextures, EvaluateTheSumsInTextureSpace) {
  const Transform toWorld = Transform::Translate({1, 2, 3}) * *Transform::Scale(2, 2, 2);
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const Point3 p(random.Uniform() * 9, random.Uniform() * 9, random.Uniform() * 9);
    const Point3 world(p.x * 2 + 1, p.y * 2 + 2, p.z * 2 + 3);
    const SurfaceInteraction si = Surface(world);
    const auto value = [&](const char* text) {
      const auto texture = plugins_.MakeFloatTexture(text, toWorld);
      EXPECT_TRUE(texture->IsFiltered());
      EXPECT_FALSE(texture->ConstantValue());
      return double(texture->Evaluate(si));
    };
    EXPECT_NEAR(value(R"("fbm")"), FbmAt(At(p, 0), {8, .5}), 1e-4);
    EXPECT_NEAR(value(R"("fbm" "integer octaves" 3 "float roughness" .7)"),
                FbmAt(At(p, 0), {3, double(Real(.7))}), 1e-4);
    EXPECT_NEAR(value(R"("wrinkled" "integer octaves" 3)"), TurbulenceAt(At(p, 0), {3, .5}), 1e-4);
    EXPECT_NEAR(value(R"("windy")"),
                std::abs(FbmAt(At(Point3(p.x / 10, p.y / 10, p.z / 10), 0), {3, .5})) *
                    FbmAt(At(p, 0), {6, .5}),
                1e-4);
    const auto grey = plugins_.MakeColorTexture(R"("fbm")", toWorld)->Evaluate(si);
    EXPECT_EQ(grey, Spectrum(Real(value(R"("fbm")"))));
  }
}

TEST_F(NoiseTextures, MarbleRunsThroughItsColoursAlongY) {
  // Without disturbance the phase is y: the sine is -1 at the first colour and 1 at the last.
  const auto plain = plugins_.MakeColorTexture(R"("marble" "float variation" 0)");
  const auto at = [&](double y) { return plain->Evaluate(Surface({5, Real(y), 7})); };
  const Spectrum first = Spectrum(Real(.58), Real(.58), Real(.6)) * Real(1.5);
  EXPECT_LT((at(-M_PI / 2) - first).MaxComponent(), Real(1e-5));
  EXPECT_LT((at(M_PI / 2) - first).MaxComponent(), Real(1e-5));
  // At a sine of 0 the fourth of six curves begins, at the fourth colour.
  EXPECT_NEAR(at(0).MaxComponent(), .75, 1e-5);
  EXPECT_NEAR(at(2 * M_PI + 1e-5).MaxComponent(), .75, 1e-4);  // curves do not join: not before it
  // scale multiplies y, and variation adds noise to it.
  const auto scaled = plugins_.MakeColorTexture(R"("marble" "float variation" 0 "float scale" 3)");
  EXPECT_NEAR(scaled->Evaluate(Surface({5, Real(.2), 7})).MaxComponent(), at(.6).MaxComponent(),
              1e-5);
  const auto disturbed =
      plugins_.MakeColorTexture(R"("marble" "float variation" 2 "integer octaves" 4)");
  const Point3 p(Real(.3), Real(.4), Real(.5));
  const double moved = .4 + 2 * FbmAt(At(p, 0), {4, .5});
  EXPECT_NEAR(disturbed->Evaluate(Surface(p)).MaxComponent(), at(moved).MaxComponent(), 1e-4);
}

TEST_F(NoiseTextures, MarbleHasItsFirstColourAtInfinity) {
  for (const char* text : {R"("marble")", R"("marble" "integer octaves" 0)"}) {
    const auto marble = plugins_.MakeColorTexture(text);
    for (const Real y : {kInfinity, -kInfinity})
      EXPECT_EQ(marble->Evaluate(Surface({0, y, 0})),
                Spectrum(Real(.58), Real(.58), Real(.6)) * Real(1.5))
          << text;
  }
}

TEST_F(NoiseTextures, DotsAreRoundAndInAboutHalfTheCells) {
  const auto dots = plugins_.MakeFloatTexture(R"("dots" "float inside" 3 "float outside" 2)");
  int cells = 0;
  double covered = 0;
  constexpr int kCells = 24, kSide = 40;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      int inside = 0, edge = 0;
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const Real s = Real(i) + (Real(x) + Real(.5)) / kSide - Real(.5);
          const Real t = Real(j) + (Real(y) + Real(.5)) / kSide - Real(.5);
          const Real value = dots->Evaluate(Surface({s, t, 0}));
          ASSERT_TRUE(value == 3 || value == 2);
          inside += value == 3;
          edge += value == 3 && (x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1);
        }
      }
      EXPECT_LE(edge, 4);  // dots stay within their cells
      cells += inside > 0;
      covered += inside;
    }
  }
  EXPECT_NEAR(cells, kCells * kCells / 2, kCells * kCells / 8);
  EXPECT_NEAR(covered / cells / (kSide * kSide), M_PI * .35 * .35, .01);
}

TEST_F(NoiseTextures, DotsOfEqualColoursAreConstant) {
  EXPECT_EQ(
      plugins_.MakeFloatTexture(R"("dots" "float inside" .5 "float outside" .5)")->ConstantValue(),
      Real(.5));
  const auto dots = plugins_.MakeColorTexture(R"("dots")");
  EXPECT_FALSE(dots->ConstantValue());
  EXPECT_FALSE(dots->IsFiltered());
  const auto scaled = plugins_.MakeFloatTexture(R"("dots" "float uscale" 2 "float vdelta" .25)");
  const auto plain = plugins_.MakeFloatTexture(R"("dots")");
  for (int i = 0; i < 200; ++i) {
    const Real u = Real(i) / 16, v = Real(i % 7) / 8;
    EXPECT_EQ(scaled->Evaluate(Surface({u, v, 0})),
              plain->Evaluate(Surface({2 * u, v + Real(.25), 0})));
  }
}

// The plan of effects may leave out a lobe whose coefficient is provably black.
TEST_F(NoiseTextures, OfNoOctavesAreProvablyBlack) {
  for (const std::string name : {"fbm", "wrinkled"}) {
    const auto none = plugins_.MakeFloatTexture("\"" + name + "\" \"integer octaves\" 0");
    EXPECT_EQ(none->ConstantValue(), Real(0)) << name;
    EXPECT_EQ(none->Evaluate(Surface({Real(.3), Real(.4), Real(.6)})), 0) << name;
    EXPECT_FALSE(none->IsFiltered()) << name;
    const auto one = plugins_.MakeColorTexture("\"" + name + "\" \"integer octaves\" 1");
    EXPECT_FALSE(one->ConstantValue()) << name;
    EXPECT_TRUE(one->IsFiltered()) << name;
  }
  EXPECT_FALSE(plugins_.MakeFloatTexture("\"windy\"")->ConstantValue());
  EXPECT_FALSE(plugins_.MakeColorTexture("\"marble\" \"integer octaves\" 0")->ConstantValue());
}

TEST_F(NoiseTextures, RefuseParametersOutOfRange) {
  for (const char* text : {R"("fbm" "integer octaves" -1)", R"("fbm" "float roughness" 4.5)",
                           R"("wrinkled" "integer octaves" 100)"})
    EXPECT_THROW(plugins_.MakeFloatTexture(text), Error) << text;
}

}  // namespace
}  // namespace exphoton
