// SPDX-License-Identifier: BSD-2-Clause
// These tests check materials through their plugins: the lobes that they announce and make, the
// meaning of their parameters, and textures with bad values.
#include "core/base/arena.h"
#include "core/base/error.h"
#include "core/math/sampling/sampling.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scattering/lobes/oren_nayar.h"
#include "gtest/gtest.h"
#include "tests/support/scattering.h"
#include "tests/support/test_plugin.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();

class Materials : public testing::Test {
 protected:
  LobeSet Possible(const std::string& text) { return plugins_.MakeMaterial(text)->PossibleLobes(); }
  Bsdf Evaluate(const std::string& text, TransportMode mode = TransportMode::Radiance) {
    SurfaceInteraction si = FlatSurface();
    return plugins_.MakeMaterial(text)->Evaluate(&si, mode, &arena_);
  }
  void ExpectError(const std::string& text) {
    EXPECT_THROW(plugins_.MakeMaterial(text), Error) << text;
  }

  TestPlugins plugins_;
  Arena arena_;
};

// Opaque returns a constant, but a material must treat it as a texture with varying values.
template <class T>
class Opaque : public Texture<T> {
 public:
  explicit Opaque(const T& value, bool isFiltered = false)
      : value_(value), isFiltered_(isFiltered) {}
  T Evaluate(const SurfaceInteraction&) const override { return value_; }
  bool IsFiltered() const override { return isFiltered_; }

 private:
  T value_;
  bool isFiltered_;
};
TexturePtr<Spectrum> OpaqueColor(const Spectrum& value, bool isFiltered = false) {
  return std::make_shared<const Opaque<Spectrum>>(value, isFiltered);
}
TexturePtr<Real> OpaqueFloat(Real value) { return std::make_shared<const Opaque<Real>>(value); }

TEST_F(Materials, AnnounceTheirLobes) {
  EXPECT_EQ(Possible(R"("matte")"), LobeSet::DiffuseReflection);
  EXPECT_EQ(Possible(R"("plastic")"), LobeSet::NonSpecularReflection);
  EXPECT_EQ(Possible(R"("mirror")"), LobeSet::SpecularReflection);
  EXPECT_EQ(Possible(R"("glass")"), LobeSet::Specular);
  EXPECT_EQ(Possible(R"("shinymetal")"), LobeSet::GlossyReflection | LobeSet::SpecularReflection);
  EXPECT_EQ(Possible(R"("metal")"), LobeSet::GlossyReflection);
  EXPECT_EQ(Possible(R"("substrate")"), LobeSet::GlossyReflection | LobeSet::DiffuseReflection);
  EXPECT_EQ(Possible(R"("substrate" "color Kd" [0 0 0])"), LobeSet::GlossyReflection);
  EXPECT_EQ(Possible(R"("translucent")"), LobeSet::NonSpecular);
  EXPECT_EQ(Possible(R"("uber")"), LobeSet::NonSpecularReflection);
}

TEST_F(Materials, LeaveOutWhatIsProvablyBlack) {
  EXPECT_EQ(Possible(R"("matte" "color Kd" [0 0 0])"), LobeSet::None);
  EXPECT_EQ(Possible(R"("plastic" "color Ks" [0 0 0])"), LobeSet::DiffuseReflection);
  EXPECT_EQ(Possible(R"("glass" "color Kr" [0 0 0])"), LobeSet::SpecularTransmission);
  EXPECT_EQ(Possible(R"("glass" "float index" 1)"), LobeSet::SpecularTransmission);
  EXPECT_EQ(Possible(R"("translucent" "color transmit" [0 0 0])"), LobeSet::NonSpecularReflection);
  EXPECT_EQ(Possible(R"("uber" "color Kr" [.1 .1 .1] "color Ks" [0 0 0])"),
            LobeSet::DiffuseReflection | LobeSet::SpecularReflection);
  EXPECT_EQ(Possible(R"("uber" "color opacity" [.5 .5 .5] "color Ks" [0 0 0])"),
            LobeSet::DiffuseReflection | LobeSet::SpecularTransmission);
  EXPECT_EQ(Possible(R"("uber" "color opacity" [0 0 0])"), LobeSet::SpecularTransmission);
}

TEST_F(Materials, MakeNoLobeThatIsBlackAtThePoint) {
  plugins_.Define("black", OpaqueColor(Spectrum()));
  EXPECT_EQ(Possible(R"("matte" "texture Kd" "black")"), LobeSet::DiffuseReflection);
  EXPECT_EQ(Evaluate(R"("matte" "texture Kd" "black")").Count(), 0);
  EXPECT_EQ(Evaluate(R"("plastic" "texture Kd" "black")").Count(), 1);
  EXPECT_EQ(Evaluate(R"("uber" "texture Kd" "black")").Count(), 1);
  EXPECT_EQ(Evaluate(R"("translucent" "texture transmit" "black")").Count(), 2);
}

TEST_F(Materials, TakeNegativeAndUndefinedTextureValuesAsZero) {
  plugins_.Define("bad", OpaqueColor({kNan, -1, Real(.5)}));
  const Bsdf bsdf = Evaluate(R"("matte" "texture Kd" "bad")");
  EXPECT_EQ(bsdf.Rho(LobeSet::All), Spectrum(0, 0, Real(.5)));
  plugins_.Define("nan", OpaqueFloat(kNan));
  plugins_.Define("negative", OpaqueFloat(-5));
  for (const std::string name : {"nan", "negative"}) {
    EXPECT_TRUE(Evaluate(R"("plastic" "texture roughness" ")" + name + "\"")
                    .f({0, 0, 1}, {0, 0, 1})
                    .IsFinite());
    EXPECT_EQ(Evaluate(R"("matte" "texture sigma" ")" + name + "\"").Rho(LobeSet::All),
              Spectrum(1));
    const auto glass = Evaluate(R"("glass" "texture index" ")" + name + "\"");
    EXPECT_EQ(glass.Sample({0, 0, 1}, {}, 0)->wi, Vector3(0, 0, -1));
  }
}

TEST_F(Materials, UseColorsAboveOneAndWarn) {
  EXPECT_EQ(Evaluate(R"("matte" "color Kd" [2 1 .5])").f({0, 0, 1}, {0, 0, 1}),
            Spectrum(2, 1, Real(.5)) * kInvPi);
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
  Evaluate(R"("matte" "color Kd" [1 1 1])");
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 1);
  EXPECT_TRUE(Evaluate(R"("substrate" "color Ks" [4 4 4])").f({0, 0, 1}, {0, 0, 1}).IsFinite());
  EXPECT_EQ(plugins_.GetLog().WarningCount(), 2);
}

// The value f(z, z) of Oren and Nayar is Kd / pi times A = 1 - s^2 / (2 (s^2 + .33)), with
// s in radians.
TEST_F(Materials, MatteTakesSigmaInDegrees) {
  const double s = 20 * 3.14159265358979 / 180;
  const Bsdf matte = Evaluate(R"("matte" "color Kd" [.6 .6 .6] "float sigma" 20)");
  EXPECT_NEAR(matte.f({0, 0, 1}, {0, 0, 1}).r,
              .6 / 3.14159265358979 * (1 - s * s / (2 * (s * s + .33))), 1e-6);
  const OrenNayar expected(Spectrum(Real(.6)), Real(s));
  for (const Vector3& wo : Directions({Real(.9), Real(.5), Real(.2)})) {
    for (const Vector3& wi : Directions({Real(.8), Real(.3)})) {
      EXPECT_NEAR(matte.f(wo, wi).r, expected.f(wo, wi).r, 1e-6);
      EXPECT_NEAR(matte.f(wo, {-wi.x, wi.y, wi.z}).r, expected.f(wo, {-wi.x, wi.y, wi.z}).r, 1e-6);
    }
  }
}

TEST_F(Materials, RefuseValuesOutOfRange) {
  ExpectError(R"("matte" "color Kd" [-1 0 0])");
  ExpectError(R"("matte" "float sigma" -1)");
  ExpectError(R"("matte" "float sigma" 91)");
  ExpectError(R"("plastic" "float roughness" -1)");
  ExpectError(R"("plastic" "string fresnel" "wrong")");
  ExpectError(R"("glass" "float index" 0)");
  ExpectError(R"("glass" "float index" -1.5)");
  ExpectError(R"("metal" "color eta" [-1 1 1])");
  ExpectError(R"("uber" "color opacity" [2 1 1])");
}

TEST_F(Materials, NeedDifferentialsOnlyForFilteredTexturesAndBumps) {
  plugins_.Define("plain", OpaqueColor(Spectrum(1)));
  plugins_.Define("filtered", OpaqueColor(Spectrum(1), true));
  plugins_.Define("bump", OpaqueFloat(1));
  const auto needs = [&](const std::string& text) {
    return plugins_.MakeMaterial(text)->NeedsDifferentials();
  };
  EXPECT_FALSE(needs(R"("uber")"));
  EXPECT_FALSE(needs(R"("matte" "texture Kd" "plain")"));
  EXPECT_TRUE(needs(R"("matte" "texture Kd" "filtered")"));
  EXPECT_TRUE(needs(R"("mirror" "texture bumpmap" "bump")"));
  EXPECT_FALSE(needs(R"("mirror" "float bumpmap" 3)"));
}

// The boundary is between the indices 1.5 and 1, as in pbrt 1 to 3, so everything beyond 41.8
// degrees is reflected totally.
TEST_F(Materials, PlasticIsInvertedUnlessToldPhysical) {
  const std::string gloss = R"("plastic" "color Kd" [0 0 0] "float roughness" .001)";
  const Vector3 a = SphericalDirection(std::sin(Radians(50)), std::cos(Radians(50)), 0);
  const Vector3 b(-a.x, 0, a.z);
  const Real inverted = Evaluate(gloss).f(a, b).r;
  const Real physical = Evaluate(gloss + R"("string fresnel" "physical")").f(a, b).r;
  EXPECT_NEAR(physical / inverted, FresnelDielectric(a.z, 1, Real(1.5)), 1e-4);
}

TEST_F(Materials, TranslucentSplitsItsLight) {
  const Bsdf bsdf = Evaluate(
      R"("translucent" "color Kd" [.8 .8 .8] "color Ks" [0 0 0]
         "color reflect" [.25 .25 .25] "color transmit" [.5 .5 .5])");
  EXPECT_NEAR(bsdf.Rho(LobeSet::DiffuseReflection).r, .2, 1e-6);
  EXPECT_NEAR(bsdf.Rho(LobeSet::DiffuseTransmission).r, .4, 1e-6);
  EXPECT_NEAR(bsdf.f({0, 0, 1}, {0, 0, -1}).r, .4 * double(kInvPi), 1e-6);
  EXPECT_NEAR(bsdf.f({0, 0, 1}, {0, 0, 1}).r, .2 * double(kInvPi), 1e-6);
}

TEST_F(Materials, UberScalesItsReflectionByOpacity) {
  const Bsdf bsdf = Evaluate(
      R"("uber" "color Kd" [.5 .5 .5] "color Ks" [0 0 0] "color Kr" [0 0 0]
         "color opacity" [.2 .2 .2])");
  EXPECT_NEAR(bsdf.Rho(LobeSet::DiffuseReflection).r, .1, 1e-6);
  const auto through = bsdf.Sample({0, 0, 1}, {}, 0, LobeSet::SpecularTransmission);
  ASSERT_TRUE(through);
  EXPECT_EQ(through->wi, Vector3(0, 0, -1));
  EXPECT_NEAR(through->throughput.r, .8, 1e-6);
}

TEST_F(Materials, UberMirrorsWithTheInvertedFresnelTerm) {
  const Bsdf bsdf = Evaluate(R"("uber" "color Kr" [.5 .5 .5])");
  const auto straight = bsdf.Sample({0, 0, 1}, {}, 0, LobeSet::Specular);
  EXPECT_NEAR(straight->throughput.r, .02, 1e-6);
  const Vector3 slant = Directions({Real(.5)})[0];
  EXPECT_NEAR(bsdf.Sample(slant, {}, 0, LobeSet::Specular)->throughput.r, .5, 1e-6);
}

// The opacity scales every lobe except the lobe that lets light through.
TEST_F(Materials, UberScalesEveryLobeByItsOpacity) {
  const std::string lobes =
      R"("uber" "color Kd" [.3 .3 .3] "color Ks" [.4 .4 .4] "color Kr" [.5 .5 .5] )";
  const Bsdf whole = Evaluate(lobes),
             quarter = Evaluate(lobes + R"("color opacity" [.25 .25 .25])");
  for (const LobeSet lobe :
       {LobeSet::DiffuseReflection, LobeSet::GlossyReflection, LobeSet::SpecularReflection})
    EXPECT_NEAR(quarter.Rho(lobe).g, .25 * double(whole.Rho(lobe).g), 1e-6);
  const Vector3 z(0, 0, 1);
  EXPECT_NEAR(quarter.f(z, z).g, .25 * double(whole.f(z, z).g), 1e-6);
  const auto mirrored = quarter.Sample(z, {}, 0, LobeSet::SpecularReflection);
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR(mirrored->throughput.g, .25 * .02, 1e-6);
}

// The index is of the mirror reflection and the gloss, as in version 2, whose default is 1.5.
TEST_F(Materials, UberTakesItsIndex) {
  const auto mirrored = [&](const std::string& rest) {
    const Bsdf bsdf = Evaluate(R"("uber" "color Kr" [1 1 1])" + rest);
    return double(bsdf.Sample({0, 0, 1}, {}, 0, LobeSet::Specular)->throughput.r);
  };
  EXPECT_NEAR(mirrored(""), .04, 1e-6);
  EXPECT_NEAR(mirrored(R"("float index" 3)"), .25, 1e-6);
  const std::string gloss = R"("uber" "color Kd" [0 0 0])";
  const Vector3 z(0, 0, 1);
  EXPECT_NEAR(Evaluate(gloss + R"("float index" 3)").f(z, z).r / Evaluate(gloss).f(z, z).r,
              .25 / .04, 1e-4);
}

// In the inverted meaning the denser side is outside, as in version 2; in the physical one inside.
TEST_F(Materials, UberRefractsByKtWithItsOpacity) {
  const std::string uber = R"("uber" "color Kd" [0 0 0] "color Ks" [0 0 0] "color Kt" [.5 .5 .5])";
  EXPECT_EQ(Possible(uber), LobeSet::SpecularTransmission);
  const Vector3 wo(Real(.6), 0, Real(.8));
  const auto pass = [&](const std::string& rest) {
    return Evaluate(uber + rest, TransportMode::Importance)
        .Sample(wo, {}, 0, LobeSet::SpecularTransmission);
  };
  const auto inverted = pass(""), physical = pass(R"("string fresnel" "physical")");
  ASSERT_TRUE(inverted && physical);
  EXPECT_NEAR(double(inverted->wi.x), -.6 * 1.5, 1e-6);
  EXPECT_NEAR(double(physical->wi.x), -.6 / 1.5, 1e-6);
  EXPECT_NEAR(double(physical->throughput.g),
              .5 * (1 - double(FresnelDielectric(Real(.8), 1, Real(1.5)))), 1e-6);
  const auto bent = pass(R"("float index" 1.2)");
  EXPECT_NEAR(double(bent->wi.x), -.6 * 1.2, 1e-6);
  // The opacity scales the refraction. The rest goes straight through.
  const Bsdf half = Evaluate(uber + R"("color opacity" [.5 .5 .5])", TransportMode::Importance);
  EXPECT_EQ(half.Count(LobeSet::SpecularTransmission), 2);
  Spectrum sum;
  for (const Bxdf* lobe : half.Lobes()) sum += lobe->Sample({0, 0, 1}, {})->throughput;
  EXPECT_NEAR(double(sum.g), .5 + .5 * .5 * .96, 1e-6);
}

TEST_F(Materials, UberWithoutKtNeverRefracts) {
  EXPECT_FALSE(Evaluate(R"("uber" "float index" 1.3)").Has(LobeSet::Transmission));
  ExpectError(R"("uber" "float index" 0)");
  ExpectError(R"("uber" "color Kt" [-1 0 0])");
}

// A texture may be transparent somewhere, whatever it is elsewhere.
TEST_F(Materials, UberOfTexturedOpacityMayLetLightThrough) {
  const LoadedScene scene = LoadSceneText(
      "WorldBegin LightSource \"point\"\nTexture \"holes\" \"color\" \"checkerboard\" \"color "
      "tex1\" [0 0 0] \"color tex2\" [1 1 1]\nMaterial \"uber\" \"texture opacity\" \"holes\"\n"
      "Shape \"sphere\"\nWorldEnd\n");
  EXPECT_TRUE(scene.setup->scene->Features().Needs(Feature::Specular));
}

// A coat that reflects all light of one colour leaves only the other colours to the base.
TEST_F(Materials, SubstrateHasItsBaseWhereTheCoatLeavesLight) {
  const std::string base = R"("substrate" "color Kd" [.5 .5 .5] "color Ks" )";
  EXPECT_TRUE(Evaluate(base + "[1 .1 .1]").Has(LobeSet::DiffuseReflection));
  EXPECT_FALSE(Evaluate(base + "[1 1 1]").Has(LobeSet::DiffuseReflection));
}

TEST_F(Materials, ShinyMetalReflectsItsColorsAtNormalIncidence) {
  const Bsdf bsdf = Evaluate(R"("shinymetal" "color Kr" [.9 .5 .2] "color Ks" [.5 .5 .5])");
  const auto mirrored = bsdf.Sample({0, 0, 1}, {}, 0, LobeSet::Specular);
  ASSERT_TRUE(mirrored);
  EXPECT_NEAR(mirrored->throughput.r, .9, 1e-5);
  EXPECT_NEAR(mirrored->throughput.b, .2, 1e-5);
  const Microfacet white(Spectrum(1), Fresnel::None(), 10);
  EXPECT_NEAR(bsdf.f({0, 0, 1}, {0, 0, 1}).r, .5 * double(white.f({0, 0, 1}, {0, 0, 1}).r), 1e-5);
}

TEST_F(Materials, MetalIsCopperUnlessToldOtherwise) {
  const Spectrum rho = Evaluate(R"("metal")").Rho(LobeSet::All);
  EXPECT_GT(rho.r, Real(.9));
  EXPECT_GT(rho.r, rho.g + Real(.2));
  EXPECT_GT(rho.g, rho.b);
}

// At normal incidence F = ((eta - 1)^2 + k^2) / ((eta + 1)^2 + k^2) and G = 1. With the exponent
// e = 1 / roughness, D = (e + 2) / (2 pi).
TEST_F(Materials, MetalTakesItsIndexAbsorptionAndRoughness) {
  const Bsdf bsdf =
      Evaluate(R"("metal" "color eta" [1.5 .2 1] "color k" [0 3 2] "float roughness" .05)");
  const Spectrum f = bsdf.f({0, 0, 1}, {0, 0, 1});
  const double d = 22 / (2 * M_PI) / 4;
  EXPECT_NEAR(double(f.r) / d, .04, 1e-4);
  EXPECT_NEAR(double(f.g) / d, (.64 + 9) / (1.44 + 9), 1e-4);
  EXPECT_NEAR(double(f.b) / d, .5, 1e-4);
  // Off the peak, D falls with the power e of the cosine of the half vector, and G stays 1.
  const Real angle = Radians(Real(20));
  const Vector3 wi(std::sin(angle), 0, std::cos(angle));
  const double half = std::cos(double(angle) / 2);
  EXPECT_NEAR(
      double(bsdf.f({0, 0, 1}, wi).b) / (.5 * d * std::pow(half, 20) / std::cos(double(angle))), 1,
      2e-3);
}

TEST_F(Materials, GlassScalesRadianceButNotPhotons) {
  const auto pass = [&](TransportMode mode) {
    return Evaluate(R"("glass" "color Kr" [0 0 0])", mode).Sample({0, 0, 1}, {}, 0)->throughput.r;
  };
  EXPECT_NEAR(pass(TransportMode::Importance), .96, 1e-5);
  EXPECT_NEAR(pass(TransportMode::Radiance), .96 / 2.25, 1e-5);
}

}  // namespace
}  // namespace exphoton
