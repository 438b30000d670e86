// SPDX-License-Identifier: BSD-2-Clause
// The plan of effects: each is on exactly where the scene calls for it.
#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kLamp = "LightSource \"point\" \"point from\" [0 0 -1]\n";
const std::string kBall = "Shape \"sphere\"\n";

EffectPlan PlanOf(const std::string& world, const std::string& camera = R"("perspective")") {
  const auto loaded = LoadSceneText("SurfaceIntegrator \"whitted\"\nTranslate 0 0 3\nCamera " +
                                    camera + "\nWorldBegin\n" + world + "WorldEnd\n");
  return loaded.setup->scene->Effects();
}

std::string Material(const std::string& text) { return "Material " + text + "\n"; }

TEST(EffectPlan, OfAMatteSceneHasIndirectLightAndNothingElse) {
  const EffectPlan plan = PlanOf(kLamp + Material(R"("matte")") + kBall);
  for (int i = 0; i < kEffectCount; ++i) {
    EXPECT_EQ(plan.Needs(Effect(i)), Effect(i) == Effect::Indirect) << EffectName(Effect(i));
    EXPECT_FALSE(plan.Get(Effect(i)).reason.empty());
  }
  EXPECT_NE(plan.Describe().find("caustics      off  no specular surface\n"), std::string::npos);
}

TEST(EffectPlan, HasCausticsOnlyWithASpecularSurfaceAReceiverAndALight) {
  const std::string matte = Material(R"("matte")") + kBall, glass = Material(R"("glass")") + kBall;
  EXPECT_TRUE(PlanOf(kLamp + matte + glass).Needs(Effect::Caustics));
  EXPECT_FALSE(PlanOf(kLamp + matte).Needs(Effect::Caustics));
  EXPECT_FALSE(PlanOf(kLamp + glass).Needs(Effect::Caustics));
  EXPECT_FALSE(PlanOf(matte + glass).Needs(Effect::Caustics));
}

TEST(EffectPlan, HasIndirectLightUnderAGlowingMediumAlone) {
  const std::string medium =
      "Volume \"homogeneous\" \"point p0\" [-1 -1 -1] \"point p1\" [1 1 1] \"color Le\" [1 1 1]\n";
  EXPECT_TRUE(PlanOf(medium + Material(R"("matte")") + kBall).Needs(Effect::Indirect));
  EXPECT_FALSE(PlanOf(Material(R"("matte")") + kBall).Needs(Effect::Indirect));
  EXPECT_TRUE(PlanOf(medium + Material(R"("plastic")") + kBall).Needs(Effect::Glossy));
}

TEST(EffectPlan, OfSpecularSurfacesOnlyHasNoIndirectLight) {
  const EffectPlan plan = PlanOf(kLamp + Material(R"("mirror")") + kBall);
  EXPECT_FALSE(plan.Needs(Effect::Indirect));
  EXPECT_EQ(plan.Get(Effect::Indirect).reason, "every surface is specular");
  EXPECT_TRUE(plan.Needs(Effect::Specular));
}

TEST(EffectPlan, TakesABlackCoefficientForNoLobeButATextureForOne) {
  const std::string black = Material(R"("mirror" "color Kr" [0 0 0])") + kBall;
  EXPECT_FALSE(PlanOf(kLamp + black).Needs(Effect::Specular));
  const std::string textured =
      "Texture \"t\" \"color\" \"checkerboard\" \"color tex1\" [0 0 0] \"color tex2\" [1 1 1]\n" +
      Material(R"("mirror" "texture Kr" "t")") + kBall;
  EXPECT_TRUE(PlanOf(kLamp + textured).Needs(Effect::Specular));
}

TEST(EffectPlan, HasTransmissionWithATranslucentSurface) {
  EXPECT_TRUE(PlanOf(kLamp + Material(R"("translucent")") + kBall).Needs(Effect::Transmission));
}

TEST(EffectPlan, SamplesGlossyLobesOnlyWithAGlossySurfaceAndALight) {
  for (const char* glossy : {R"("plastic")", R"("substrate")", R"("metal")", R"("uber")",
                             R"("shinymetal")", R"("translucent")"}) {
    EXPECT_TRUE(PlanOf(kLamp + Material(glossy) + kBall).Needs(Effect::Glossy)) << glossy;
    EXPECT_FALSE(PlanOf(Material(glossy) + kBall).Needs(Effect::Glossy)) << glossy;
  }
  const EffectPlan matte = PlanOf(kLamp + Material(R"("matte")") + kBall);
  EXPECT_FALSE(matte.Needs(Effect::Glossy));
  EXPECT_EQ(matte.Get(Effect::Glossy).reason, "no glossy surface");
  const std::string dull = Material(R"("plastic" "color Ks" [0 0 0])") + kBall;
  EXPECT_FALSE(PlanOf(kLamp + dull).Needs(Effect::Glossy));
}

TEST(EffectPlan, FiltersOnlyFilteredTextures) {
  const auto floor = [](const std::string& textureClass) {
    return "Texture \"t\" \"color\" " + textureClass + "\n" +
           Material(R"("matte" "texture Kd" "t")") + kBall;
  };
  EXPECT_TRUE(PlanOf(kLamp + floor(R"("checkerboard")")).Needs(Effect::Filtering));
  EXPECT_FALSE(
      PlanOf(kLamp + floor(R"("checkerboard" "string aamode" "none")")).Needs(Effect::Filtering));
}

TEST(EffectPlan, HasLensSamplesOnlyWithALens) {
  EXPECT_TRUE(PlanOf(kLamp + kBall, R"("perspective" "float lensradius" .1)").Needs(Effect::Lens));
}

TEST(EffectPlan, BlursNothingThatDoesNotMove) {
  const EffectPlan open = PlanOf(kLamp + kBall, R"("perspective" "float shutterclose" 1)");
  EXPECT_FALSE(open.Needs(Effect::Motion));
  EXPECT_EQ(open.Get(Effect::Motion).reason, "nothing moves");
}

const std::string kMovingBall =
    "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\n" + kBall;

TEST(EffectPlan, BlursWhatMovesWhileTheShutterIsOpen) {
  const EffectPlan shape = PlanOf(kLamp + kMovingBall);
  EXPECT_TRUE(shape.Needs(Effect::Motion));
  EXPECT_EQ(shape.Get(Effect::Motion).reason, "a shape moves");
  EXPECT_EQ(shape.notes.back(), "time          0 to 1 (of camera rays and photons)");
  const EffectPlan closed = PlanOf(
      kLamp + kMovingBall, R"("perspective" "float shutteropen" .25 "float shutterclose" .25)");
  EXPECT_FALSE(closed.Needs(Effect::Motion));
  EXPECT_EQ(closed.Get(Effect::Motion).reason, "shutter closed");
  EXPECT_EQ(closed.notes.back(), "time          0.25 (of camera rays and photons)");
  const EffectPlan late =
      PlanOf(kLamp + kMovingBall, R"("perspective" "float shutteropen" 1 "float shutterclose" 2)");
  EXPECT_FALSE(late.Needs(Effect::Motion));
  EXPECT_EQ(late.Get(Effect::Motion).reason, "nothing moves while the shutter is open");
}

TEST(EffectPlan, BlursWhatAMovingCameraSees) {
  const auto plan = [](const std::string& world) {
    return LoadSceneText(
               "ActiveTransform EndTime Translate 0 0 1\nCamera \"perspective\"\n"
               "WorldBegin\n" +
               world + "WorldEnd\n")
        .setup->scene->Effects();
  };
  EXPECT_EQ(plan(kLamp + kBall).Get(Effect::Motion).reason, "the camera moves");
  EXPECT_EQ(plan(kLamp + kMovingBall).Get(Effect::Motion).reason, "the camera and a shape move");
}

TEST(EffectPlan, SeesTheSkyOnlyIfItShines) {
  EXPECT_TRUE(PlanOf("LightSource \"infinite\"\n" + kBall).Needs(Effect::Environment));
  EXPECT_FALSE(
      PlanOf("LightSource \"infinite\" \"color L\" [0 0 0]\n" + kBall).Needs(Effect::Environment));
}

TEST(EffectPlan, CountsBlackLightsApart) {
  const EffectPlan plan =
      PlanOf(kLamp + kLamp + "LightSource \"distant\" \"color L\" [0 0 0]\n" + kBall);
  ASSERT_FALSE(plan.notes.empty());
  EXPECT_EQ(plan.notes[0], "lights        3 (1 black, skipped)");
}

TEST(EffectPlan, BeforeItIsPlannedHasEverythingOn) {
  const EffectPlan plan;
  for (int i = 0; i < kEffectCount; ++i) EXPECT_TRUE(plan.Needs(Effect(i)));
}

}  // namespace
}  // namespace exphoton
