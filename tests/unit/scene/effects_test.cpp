// SPDX-License-Identifier: BSD-2-Clause
// These tests check feature culling: each effect is on exactly where the scene requires it.
#include <gtest/gtest.h>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kPlainLamp = "LightSource \"point\" \"point from\" [0 0 -1]\n";
const std::string kBall = "Shape \"sphere\"\n";

RequiredFeatures PlanOf(const std::string& world, const std::string& camera = R"("perspective")") {
  const auto loaded = LoadSceneText("SurfaceIntegrator \"exphotonmap\"\nTranslate 0 0 3\nCamera " +
                                    camera + "\nWorldBegin\n" + world + "WorldEnd\n");
  return loaded.setup->scene->Features();
}

std::string MaterialLine(const std::string& text) { return "Material " + text + "\n"; }

TEST(RequiredFeatures, OfAMatteSceneHasIndirectLightAndNothingElse) {
  const RequiredFeatures plan = PlanOf(kPlainLamp + MaterialLine(R"("matte")") + kBall);
  for (int i = 0; i < kFeatureCount; ++i) {
    EXPECT_EQ(plan.Needs(Feature(i)), Feature(i) == Feature::Indirect) << FeatureName(Feature(i));
    EXPECT_FALSE(plan.Get(Feature(i)).reason.empty());
  }
  EXPECT_NE(plan.Describe().find("caustics      off  no specular surface\n"), std::string::npos);
}

TEST(RequiredFeatures, HasCausticsOnlyWithASpecularSurfaceAReceiverAndALight) {
  const std::string matte = MaterialLine(R"("matte")") + kBall,
                    glass = MaterialLine(R"("glass")") + kBall;
  EXPECT_TRUE(PlanOf(kPlainLamp + matte + glass).Needs(Feature::Caustics));
  EXPECT_FALSE(PlanOf(kPlainLamp + matte).Needs(Feature::Caustics));
  EXPECT_FALSE(PlanOf(kPlainLamp + glass).Needs(Feature::Caustics));
  EXPECT_FALSE(PlanOf(matte + glass).Needs(Feature::Caustics));
}

TEST(RequiredFeatures, HasIndirectLightUnderAGlowingMediumAlone) {
  const std::string medium =
      "Volume \"homogeneous\" \"point p0\" [-1 -1 -1] \"point p1\" [1 1 1] \"color Le\" [1 1 1]\n";
  EXPECT_TRUE(PlanOf(medium + MaterialLine(R"("matte")") + kBall).Needs(Feature::Indirect));
  EXPECT_FALSE(PlanOf(MaterialLine(R"("matte")") + kBall).Needs(Feature::Indirect));
  EXPECT_TRUE(PlanOf(medium + MaterialLine(R"("plastic")") + kBall).Needs(Feature::Glossy));
}

TEST(RequiredFeatures, HasIndirectLightUnderAnyOfSeveralMediaThatGlows) {
  const auto medium = [](const std::string& color) {
    return "Volume \"homogeneous\" \"point p1\" [1 1 1] \"color " + color + "\" [1 1 1]\n";
  };
  const std::string glow = medium("Le"), fog = medium("sigma_s"), ball = kBall;
  EXPECT_TRUE(PlanOf(glow + fog + ball).Needs(Feature::Indirect));
  EXPECT_TRUE(PlanOf(fog + glow + ball).Needs(Feature::Indirect));
  EXPECT_TRUE(PlanOf(fog + glow + fog + ball).Needs(Feature::Indirect));
  EXPECT_FALSE(PlanOf(fog + fog + ball).Needs(Feature::Indirect));
}

TEST(RequiredFeatures, MarchesThroughNoEmptyMedia) {
  const auto plan = [](const std::string& media) { return PlanOf(kPlainLamp + media + kBall); };
  const std::string empty = "Volume \"homogeneous\" \"color sigma_a\" [0 0 0]\n";
  const std::string fog = "Volume \"homogeneous\" \"color sigma_a\" [1 0 0]\n";
  EXPECT_EQ(plan("").Get(Feature::Media).reason, "no participating medium");
  EXPECT_FALSE(plan(empty).Needs(Feature::Media));
  EXPECT_EQ(plan(empty).Get(Feature::Media).reason, "no medium absorbs, scatters or emits light");
  EXPECT_FALSE(plan(empty + empty).Needs(Feature::Media));
  // The scene has removed the medium, and another render plans it again.
  const LoadedScene loaded =
      LoadSceneText("WorldBegin\n" + std::string(kPlainLamp) + empty + kBall + "WorldEnd\n");
  const RequiredFeatures again = FindRequiredFeatures(*loaded.setup->scene, *loaded.setup->camera);
  EXPECT_EQ(again.Get(Feature::Media).reason, "no medium absorbs, scatters or emits light");
  EXPECT_TRUE(plan(fog).Needs(Feature::Media));
  EXPECT_TRUE(plan(empty + fog).Needs(Feature::Media));
  EXPECT_TRUE(plan(fog + empty).Needs(Feature::Media));
}

TEST(RequiredFeatures, OfSpecularSurfacesOnlyHasNoIndirectLight) {
  const RequiredFeatures plan = PlanOf(kPlainLamp + MaterialLine(R"("mirror")") + kBall);
  EXPECT_FALSE(plan.Needs(Feature::Indirect));
  EXPECT_EQ(plan.Get(Feature::Indirect).reason, "every surface is specular");
  EXPECT_TRUE(plan.Needs(Feature::Specular));
}

TEST(RequiredFeatures, TakesABlackCoefficientForNoLobeButATextureForOne) {
  const std::string black = MaterialLine(R"("mirror" "color Kr" [0 0 0])") + kBall;
  EXPECT_FALSE(PlanOf(kPlainLamp + black).Needs(Feature::Specular));
  const std::string textured =
      "Texture \"t\" \"color\" \"checkerboard\" \"color tex1\" [0 0 0] \"color tex2\" [1 1 1]\n" +
      MaterialLine(R"("mirror" "texture Kr" "t")") + kBall;
  EXPECT_TRUE(PlanOf(kPlainLamp + textured).Needs(Feature::Specular));
}

TEST(RequiredFeatures, HasTransmissionWithATranslucentSurface) {
  EXPECT_TRUE(
      PlanOf(kPlainLamp + MaterialLine(R"("translucent")") + kBall).Needs(Feature::Transmission));
}

TEST(RequiredFeatures, HasTransmissionWithASurfaceThatReflectsNothing) {
  const auto plan = [](const std::string& parameters) {
    return PlanOf(kPlainLamp + MaterialLine("\"translucent\" \"color Ks\" [0 0 0] " + parameters) +
                  kBall);
  };
  EXPECT_TRUE(plan("\"color reflect\" [0 0 0]").Needs(Feature::Transmission));
  EXPECT_FALSE(plan("\"color transmit\" [0 0 0]").Needs(Feature::Transmission));
}

TEST(RequiredFeatures, SamplesGlossyLobesOnlyWithAGlossySurfaceAndALight) {
  for (const char* glossy : {R"("plastic")", R"("substrate")", R"("metal")", R"("uber")",
                             R"("shinymetal")", R"("translucent")"}) {
    EXPECT_TRUE(PlanOf(kPlainLamp + MaterialLine(glossy) + kBall).Needs(Feature::Glossy)) << glossy;
    EXPECT_FALSE(PlanOf(MaterialLine(glossy) + kBall).Needs(Feature::Glossy)) << glossy;
  }
  const RequiredFeatures matte = PlanOf(kPlainLamp + MaterialLine(R"("matte")") + kBall);
  EXPECT_FALSE(matte.Needs(Feature::Glossy));
  EXPECT_EQ(matte.Get(Feature::Glossy).reason, "no glossy surface");
  const std::string dull = MaterialLine(R"("plastic" "color Ks" [0 0 0])") + kBall;
  EXPECT_FALSE(PlanOf(kPlainLamp + dull).Needs(Feature::Glossy));
}

TEST(RequiredFeatures, FiltersOnlyFilteredTextures) {
  const auto floor = [](const std::string& textureClass) {
    return "Texture \"t\" \"color\" " + textureClass + "\n" +
           MaterialLine(R"("matte" "texture Kd" "t")") + kBall;
  };
  EXPECT_TRUE(PlanOf(kPlainLamp + floor(R"("checkerboard")")).Needs(Feature::Filtering));
  EXPECT_FALSE(PlanOf(kPlainLamp + floor(R"("checkerboard" "string aamode" "none")"))
                   .Needs(Feature::Filtering));
}

// The scene has a matte ball and an object that no instance places in it.
TEST(RequiredFeatures, DoesNotCountObjectsWithoutAnInstance) {
  const std::string place = "ObjectInstance \"o\"\n", ball = kPlainLamp + kBall;
  const auto object = [](const std::string& shapes) {
    return "ObjectBegin \"o\"\n" + shapes + "ObjectEnd\n";
  };
  const auto expect = [&](const std::string& shapes, Feature feature) {
    EXPECT_FALSE(PlanOf(ball + object(shapes)).Needs(feature)) << shapes;
    EXPECT_TRUE(PlanOf(ball + object(shapes) + place).Needs(feature)) << shapes;
  };
  const std::string glass = MaterialLine(R"("glass")") + kBall;
  expect(glass, Feature::Caustics);
  expect(glass, Feature::Specular);
  expect("ActiveTransform EndTime Translate 0 0 1 ActiveTransform All\n" + glass,
         Feature::Specular);
  expect(MaterialLine(R"("translucent")") + kBall, Feature::Transmission);
  expect(MaterialLine(R"("plastic")") + kBall, Feature::Glossy);
  expect("Texture \"c\" \"color\" \"checkerboard\"\n" +
             MaterialLine(R"("matte" "texture Kd" "c")") + kBall,
         Feature::Filtering);
}

TEST(RequiredFeatures, DoesNotCountMeshesWithoutVisibleTriangles) {
  const auto mesh = [](const std::string& corner, const std::string& alpha) {
    return kPlainLamp + kBall + MaterialLine(R"("mirror")") +
           "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 0 1 0 " + corner +
           "] \"float alpha\" " + alpha + "\n";
  };
  EXPECT_TRUE(PlanOf(mesh("1 0 0", "1")).Needs(Feature::Specular));
  EXPECT_FALSE(PlanOf(mesh("1 0 0", "0")).Needs(Feature::Specular));
  EXPECT_FALSE(PlanOf(mesh("0 2 0", "1")).Needs(Feature::Specular));
}

TEST(RequiredFeatures, HasLensSamplesOnlyWithALens) {
  EXPECT_TRUE(
      PlanOf(kPlainLamp + kBall, R"("perspective" "float lensradius" .1)").Needs(Feature::Lens));
}

TEST(RequiredFeatures, BlursNothingThatDoesNotMove) {
  const RequiredFeatures open =
      PlanOf(kPlainLamp + kBall, R"("perspective" "float shutterclose" 1)");
  EXPECT_FALSE(open.Needs(Feature::Motion));
  EXPECT_EQ(open.Get(Feature::Motion).reason, "nothing moves");
}

const std::string kMovingBall =
    "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\n" + kBall;

TEST(RequiredFeatures, BlursWhatMovesWhileTheShutterIsOpen) {
  const RequiredFeatures shape = PlanOf(kPlainLamp + kMovingBall);
  EXPECT_TRUE(shape.Needs(Feature::Motion));
  EXPECT_EQ(shape.Get(Feature::Motion).reason, "a shape moves");
  EXPECT_EQ(shape.notes.back(), "time          0 to 1 (of camera rays and photons)");
  const RequiredFeatures closed =
      PlanOf(kPlainLamp + kMovingBall,
             R"("perspective" "float shutteropen" .25 "float shutterclose" .25)");
  EXPECT_FALSE(closed.Needs(Feature::Motion));
  EXPECT_EQ(closed.Get(Feature::Motion).reason, "shutter closed");
  EXPECT_EQ(closed.notes.back(), "time          0.25 (of camera rays and photons)");
  const RequiredFeatures late = PlanOf(
      kPlainLamp + kMovingBall, R"("perspective" "float shutteropen" 1 "float shutterclose" 2)");
  EXPECT_FALSE(late.Needs(Feature::Motion));
  EXPECT_EQ(late.Get(Feature::Motion).reason, "nothing moves while the shutter is open");
}

TEST(RequiredFeatures, BlursWhatAMovingCameraSees) {
  const auto plan = [](const std::string& world) {
    return LoadSceneText(
               "ActiveTransform EndTime Translate 0 0 1\nCamera \"perspective\"\n"
               "WorldBegin\n" +
               world + "WorldEnd\n")
        .setup->scene->Features();
  };
  EXPECT_EQ(plan(kPlainLamp + kBall).Get(Feature::Motion).reason, "the camera moves");
  EXPECT_EQ(plan(kPlainLamp + kMovingBall).Get(Feature::Motion).reason,
            "the camera and a shape move");
}

TEST(RequiredFeatures, SeesTheSkyOnlyIfItShines) {
  EXPECT_TRUE(PlanOf("LightSource \"infinite\"\n" + kBall).Needs(Feature::Environment));
  EXPECT_FALSE(
      PlanOf("LightSource \"infinite\" \"color L\" [0 0 0]\n" + kBall).Needs(Feature::Environment));
}

TEST(RequiredFeatures, CountsBlackLightsApart) {
  const RequiredFeatures plan =
      PlanOf(kPlainLamp + kPlainLamp + "LightSource \"distant\" \"color L\" [0 0 0]\n" + kBall);
  ASSERT_FALSE(plan.notes.empty());
  EXPECT_EQ(plan.notes[0], "lights        3 (1 black, skipped)");
}

// A scene that needs every effect but motion.
const std::string kEverything =
    "LightSource \"infinite\"\nVolume \"homogeneous\" \"color sigma_a\" [1 1 1]\n"
    "Material \"glass\"\nShape \"sphere\"\n"
    "Texture \"t\" \"color\" \"checkerboard\"\nMaterial \"translucent\" \"texture Kd\" \"t\"\n"
    "Shape \"disk\"\n";

// Returns the names of the effects that are off for an integrator.
std::string OffWith(const std::string& integrator, const std::string& effects = "auto") {
  LoadOptions options;
  options.effects = effects;
  const LoadedScene scene =
      LoadSceneText("SurfaceIntegrator " + integrator +
                        "\nCamera \"perspective\" \"float lensradius\" .1\nWorldBegin\n" +
                        kEverything + "WorldEnd\n",
                    options);
  const RequiredFeatures& plan = scene.setup->scene->Features();
  std::string off;
  for (int i = 0; i < kFeatureCount; ++i) {
    if (Feature(i) == Feature::Motion || plan.Needs(Feature(i))) continue;
    off += (off.empty() ? "" : " ") + std::string(FeatureName(Feature(i)));
    EXPECT_EQ(plan.Get(Feature(i)).reason.rfind("this integrator ", 0), 0u) << off;
  }
  return off;
}

TEST(RequiredFeatures, LeaveOutWhatTheIntegratorDoesNotCompute) {
  const std::string direct = "caustics indirect transmission glossy";
  const struct {
    const char *integrator, *off;
  } cases[] = {
      {"\"exphotonmap\"", ""},
      {"\"exphotonmap\" \"integer causticphotons\" 0", "caustics"},
      {"\"exphotonmap\" \"bool radiancephotons\" \"false\"", "transmission glossy"},
      {"\"photonmap\"", "transmission glossy"},
      {"\"photonmap\" \"bool finalgather\" \"false\" \"integer indirectphotons\" 0",
       "indirect transmission glossy"},
      {"\"path\"", "transmission glossy"},
      {"\"guidedpath\"", "transmission glossy"},
      {"\"bidirectional\"", "transmission glossy"},
      {"\"irradiancecache\"", "transmission glossy"},
      {"\"irradiancecache\" \"integer maxindirectdepth\" 0", direct.c_str()},
      {"\"igi\"", "caustics transmission glossy"},
      {"\"igi\" \"float indirectscale\" 0", direct.c_str()},
      {"\"directlighting\"", direct.c_str()},
      {"\"whitted\"", direct.c_str()},
      {"\"ambientocclusion\"", "caustics indirect transmission specular glossy media filtering"},
      {"\"debug\"", "caustics indirect transmission specular glossy media environment"},
  };
  for (const auto& [integrator, off] : cases) {
    EXPECT_EQ(OffWith(integrator), off) << integrator;
    EXPECT_EQ(OffWith(integrator, "all"), off) << integrator;
  }
}

TEST(RequiredFeatures, SayWhyTheIntegratorLeavesThemOut) {
  const LoadedScene scene = LoadSceneText("SurfaceIntegrator \"directlighting\"\nWorldBegin\n" +
                                          kPlainLamp + MaterialLine("\"glass\"") + kBall +
                                          MaterialLine("\"matte\"") + kBall + "WorldEnd\n");
  const std::string text = scene.setup->scene->Features().Describe();
  EXPECT_NE(text.find("caustics      off  this integrator does not compute caustics\n"),
            std::string::npos);
  EXPECT_NE(text.find("indirect      off  this integrator does not compute indirect light\n"),
            std::string::npos);
  // A reason that lies in the scene comes first.
  EXPECT_NE(text.find("glossy        off  no glossy surface\n"), std::string::npos);
}

TEST(RequiredFeatures, BeforeItIsPlannedHasEverythingOn) {
  const RequiredFeatures plan;
  for (int i = 0; i < kFeatureCount; ++i) EXPECT_TRUE(plan.Needs(Feature(i)));
}

}  // namespace
}  // namespace exphoton
