// SPDX-License-Identifier: BSD-2-Clause
// These tests check material "mix": pictures with the amounts 0, 1 and between, the scope of the
// names, and messages.
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

const std::string kParts = R"(
MakeNamedMaterial "a" "string type" "plastic" "color Kd" [.2 .4 .6] "color Ks" [.3 .3 .3]
MakeNamedMaterial "b" "string type" "matte" "color Kd" [.6 .1 .2] "float sigma" 20
)";

std::string Scene(const std::string& integrator, const std::string& material) {
  return TestHeader("\"" + integrator + "\"", 8, 8, 4) + "WorldBegin\nLightSource \"point\" " +
         "\"point from\" [1 2 -3]\nLightSource \"infinite\" \"color L\" [.1 .1 .1]\n" + kParts +
         material + "\nTranslate 0 0 2 Shape \"sphere\"\nWorldEnd\n";
}

std::vector<float> Pixels(const std::string& material, const std::string& integrator = "path") {
  return RenderSceneText(Scene(integrator, material)).image.pixels;
}

std::string Mix(const std::string& amount) {
  return "Material \"mix\" \"color amount\" [" + amount +
         "] \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"";
}

std::string ErrorOf(const std::string& material) {
  try {
    LoadSceneText(Scene("path", material));
  } catch (const Error& error) {
    return std::string(error.what()) + "|" + error.Hint();
  }
  return "";
}

TEST(MixMaterial, OfAmountOneOrZeroIsThePartBitForBit) {
  for (const char* integrator : {"whitted", "path", "exphotonmap"}) {
    const auto a = Pixels("NamedMaterial \"a\"", integrator);
    const auto b = Pixels("NamedMaterial \"b\"", integrator);
    EXPECT_NE(a, b);
    EXPECT_EQ(Pixels(Mix("1 1 1"), integrator), a) << integrator;
    EXPECT_EQ(Pixels(Mix("0 0 0"), integrator), b) << integrator;
  }
}

// Direct light is linear in the BSDF, and "whitted" has no random choice.
TEST(MixMaterial, BetweenIsTheWeightedSumOfItsParts) {
  const auto a = Pixels("NamedMaterial \"a\"", "whitted");
  const auto b = Pixels("NamedMaterial \"b\"", "whitted");
  const auto mixed = Pixels(Mix(".25 .5 1"), "whitted");
  const std::size_t channels = mixed.size() / 64;
  constexpr double kAmounts[3] = {.25, .5, 1};
  double largest = 0;
  for (std::size_t i = 0; i < mixed.size(); ++i) {
    const std::size_t c = i % channels;
    if (c >= 3) continue;
    const double expected = kAmounts[c] * double(a[i]) + (1 - kAmounts[c]) * double(b[i]);
    EXPECT_NEAR(double(mixed[i]), expected, 2e-5 * (1 + expected));
    largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
  }
  EXPECT_GT(largest, .01);
}

TEST(MixMaterial, IsAnEqualBlendByDefault) {
  EXPECT_EQ(Pixels("Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" "
                   "\"b\""),
            Pixels(Mix(".5 .5 .5")));
}

TEST(MixMaterial, OfMixesWorks) {
  const std::string inner =
      "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"color amount\" [1 1 1] \"string "
      "namedmaterial1\" \"b\" \"string namedmaterial2\" \"a\"\n";
  EXPECT_EQ(Pixels(inner + "Material \"mix\" \"color amount\" [0 0 0] \"string namedmaterial1\" "
                           "\"a\" \"string namedmaterial2\" \"m\""),
            Pixels("NamedMaterial \"b\""));
}

TEST(MixMaterial, KeepsThePartsThatTheirNamesMeantWhereItWasMade) {
  const std::string redefined =
      "\nMakeNamedMaterial \"a\" \"string type\" \"matte\" \"color Kd\" [1 1 1]\n";
  EXPECT_EQ(Pixels(Mix("1 1 1") + redefined), Pixels("NamedMaterial \"a\""));
}

TEST(MixMaterial, TakesAnAmountOfAShape) {
  EXPECT_EQ(
      RenderSceneText(TestHeader("\"path\"", 8, 8, 4) +
                      "WorldBegin\nLightSource \"point\" \"point from\" [1 2 -3]\n" + kParts +
                      Mix(".5 .5 .5") +
                      "\nTranslate 0 0 2 Shape \"sphere\" \"color amount\" [1 1 1]\nWorldEnd\n")
          .image.pixels,
      RenderSceneText(TestHeader("\"path\"", 8, 8, 4) +
                      "WorldBegin\nLightSource \"point\" \"point from\" [1 2 -3]\n" + kParts +
                      "NamedMaterial \"a\"\nTranslate 0 0 2 Shape \"sphere\"\nWorldEnd\n")
          .image.pixels);
}

TEST(MixMaterial, OfAnUnknownPartIsAnError) {
  EXPECT_EQ(
      ErrorOf("MakeNamedMaterial \"gold\" \"string type\" \"matte\"\nMaterial \"mix\" "
              "\"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"golt\""),
      "parameter \"namedmaterial2\" of material \"mix\" names a material \"golt\" that has not "
      "been defined|did you mean \"gold\"?");
  EXPECT_NE(ErrorOf("Material \"mix\" \"string namedmaterial1\" \"a\"").find("namedmaterial2"),
            std::string::npos);
  EXPECT_NE(ErrorOf("Material \"mix\" \"color amount\" [2 0 0] \"string namedmaterial1\" \"a\" "
                    "\"string namedmaterial2\" \"b\"")
                .find("between 0 and 1"),
            std::string::npos);
}

TEST(MixMaterial, OfItselfIsAnErrorAndNoEndlessLoop) {
  EXPECT_NE(ErrorOf("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string namedmaterial1\" "
                    "\"m\" \"string namedmaterial2\" \"a\"\nNamedMaterial \"m\"")
                .find("chain of more than 32 materials"),
            std::string::npos);
}

TEST(MixMaterial, OfTooManyLobesIsAnError) {
  std::string text;
  for (int i = 1; i <= 3; ++i) {
    const std::string part = i == 1 ? "a" : "m" + std::to_string(i - 1);
    text += "MakeNamedMaterial \"m" + std::to_string(i) +
            "\" \"string type\" \"mix\" \"string namedmaterial1\" \"" + part +
            "\" \"string namedmaterial2\" \"" + part + "\"\n";
  }
  EXPECT_EQ(ErrorOf(text + "NamedMaterial \"m2\""), "");
  EXPECT_NE(ErrorOf(text + "NamedMaterial \"m3\"").find("a mix of 16 lobes; a surface can have 8"),
            std::string::npos);
}

TEST(MixMaterial, AnnouncesTheLobesOfTheUsedParts) {
  const auto needs = [](const std::string& amount) {
    const LoadedScene scene = LoadSceneText(
        "WorldBegin LightSource \"point\"\nMakeNamedMaterial \"a\" \"string type\" \"mirror\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"matte\"\n" +
        Mix(amount) + "\nShape \"sphere\"\nWorldEnd\n");
    return scene.setup->scene->Features().Needs(Feature::Specular);
  };
  EXPECT_TRUE(needs(".5 .5 .5"));
  EXPECT_FALSE(needs("0 0 0"));
}

TEST(MixMaterial, OfAmountZeroHasTheLobesOfTheSecondPart) {
  const LoadedScene scene = LoadSceneText(
      "WorldBegin LightSource \"point\"\nMakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
      "MakeNamedMaterial \"b\" \"string type\" \"mirror\"\n" +
      Mix("0 0 0") + "\nShape \"sphere\"\nWorldEnd\n");
  EXPECT_TRUE(scene.setup->scene->Features().Needs(Feature::Specular));
}

// Returns whether the surface of an equal blend of a substrate and the other material is coated.
bool IsCoatedMix(const std::string& other) {
  const LoadedScene scene = LoadSceneText(
      "WorldBegin LightSource \"point\"\n"
      "MakeNamedMaterial \"c\" \"string type\" \"substrate\"\n"
      "MakeNamedMaterial \"b\" \"string type\" " +
      other +
      "\nMaterial \"mix\" \"string namedmaterial1\" \"c\" \"string namedmaterial2\" \"b\"\n"
      "Shape \"sphere\"\nWorldEnd\n");
  SurfaceInteraction si;
  si.ng = si.shading.n = {0, 0, 1};
  si.dpdu = si.shading.dpdu = {1, 0, 0};
  si.dpdv = {0, 1, 0};
  Arena arena;
  bool isFound = false, isCoated = false;
  for (const auto& material : scene.setup->scene->Materials()) {
    const Bsdf bsdf = material->Evaluate(&si, TransportMode::Radiance, &arena);
    isFound = isFound || bsdf.Lobes().size() > 1;
    isCoated = isCoated || bsdf.IsCoated();
  }
  EXPECT_TRUE(isFound) << other;
  return isCoated;
}

// Photon maps lower what they store on a coated base by its coat. The plain part has none.
TEST(MixMaterial, OfACoatedAndAPlainPartIsNotCoated) { EXPECT_FALSE(IsCoatedMix("\"matte\"")); }

// The radiance photons of a coated surface lower the light that comes through it, too.
TEST(MixMaterial, OfACoatedPartAndOneThatTransmitsDiffuselyIsNotCoated) {
  EXPECT_FALSE(IsCoatedMix("\"translucent\" \"color reflect\" [0 0 0] \"color transmit\" [1 1 1]"));
  EXPECT_TRUE(IsCoatedMix("\"mirror\""));
}

}  // namespace
}  // namespace exphoton
