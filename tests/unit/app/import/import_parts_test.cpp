// SPDX-License-Identifier: BSD-2-Clause
// These tests convert single materials, lights, shapes and textures of versions 3 and 4.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/app/import/directive_text.h"
#include "core/app/import/materials/material_parts.h"
#include "tests/unit/app/import/import_support.h"

namespace exphoton::cli {
namespace {

std::string LastMaterial(const Imported& imported) {
  const std::size_t at = imported.text.rfind("Material ");
  if (at == std::string::npos) return "";
  return imported.text.substr(at, imported.text.find('\n', at) - at);
}
std::string Material3(const std::string& text) { return LastMaterial(World3(text)); }
std::string Material4(const std::string& text) { return LastMaterial(World4(text)); }

TEST(Import, ConvertsMaterialsOfVersion3) {
  EXPECT_EQ(Material3("Material \"matte\" \"rgb Kd\" [.1 .2 .3] \"float sigma\" 20"),
            "Material \"matte\" \"color Kd\" [0.1 0.2 0.3] \"float sigma\" [20]");
  EXPECT_EQ(Material3("Material \"mirror\""), "Material \"mirror\" \"color Kr\" [0.9 0.9 0.9]");
  EXPECT_EQ(Material3("Material \"glass\" \"float eta\" 1.3"),
            "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1] \"float index\" [1.3]");
  EXPECT_EQ(Material3("Material \"uber\" \"float roughness\" .5 \"bool remaproughness\" \"false\""),
            "Material \"uber\" \"color Kd\" [0.25 0.25 0.25] \"color Ks\" [0.25 0.25 0.25] "
            "\"color Kr\" [0 0 0] \"color Kt\" [0 0 0] \"color opacity\" [1 1 1] "
            "\"float index\" [1.5] \"string fresnel\" [\"physical\"] "
            "\"float roughness\" [0.16666666666666666]");
  EXPECT_TRUE(World3("Material \"substrate\" \"float uroughness\" .2").isExact);
  EXPECT_TRUE(World3("Material \"metal\"").isExact);
  EXPECT_TRUE(World3("Material \"translucent\" \"rgb Ks\" [0 0 0]").isExact);
  EXPECT_FALSE(World3("Material \"glass\" \"float uroughness\" .2").isExact);
  EXPECT_FALSE(World3("Material \"disney\"").isExact);
}

TEST(Import, ConvertsMaterialsOfVersion4) {
  EXPECT_EQ(Material4("Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]"),
            "Material \"matte\" \"color Kd\" [0.1 0.2 0.3]");
  EXPECT_EQ(Material4("Material \"diffusetransmission\" \"rgb reflectance\" [.1 .2 .3] "
                      "\"rgb transmittance\" [.4 .4 .4] \"float scale\" .5"),
            "Material \"translucent\" \"color Kd\" [0.5 0.5 0.5] \"color Ks\" [0 0 0] "
            "\"color reflect\" [0.1 0.2 0.3] \"color transmit\" [0.4 0.4 0.4]");
  EXPECT_EQ(
      Material4("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\""),
      "Material \"glass\" \"color Kr\" [1 1 1] \"color Kt\" [1 1 1] \"float index\" [1.5168]");
  EXPECT_NE(Material4("Material \"conductor\" \"float roughness\" .25").find("\"metal\""),
            std::string::npos);
}

std::array<double, 3> ColorIn(const std::string& text, const std::string& name) {
  std::array<double, 3> c{};
  const std::size_t at = text.find("\"color " + name + "\" [");
  EXPECT_NE(at, std::string::npos) << text;
  if (at == std::string::npos) return c;
  const char* list = text.c_str() + text.find('[', at);
  EXPECT_EQ(std::sscanf(list, "[%lf %lf %lf]", &c[0], &c[1], &c[2]), 3);
  return c;
}

TEST(Import, SmoothConductorKeepsItsReflectanceAtNormalIncidence) {
  const auto kr = ColorIn(Material4("Material \"conductor\" \"rgb reflectance\" [.2 .5 .8]"), "Kr");
  EXPECT_NEAR(kr[0], .2, 1e-12);
  EXPECT_NEAR(kr[1], .5, 1e-12);
  EXPECT_NEAR(kr[2], .8, 1e-12);
}

// Without absorption, the coat of index 1.5 reflects 9.2 % of diffuse light, and the rest comes out
// of the base.
TEST(Import, CoatedBaseLosesTheLightThatTheCoatReflects) {
  const std::string text = Material4("Material \"coateddiffuse\" \"rgb reflectance\" [1 .5 0]");
  const auto kd = ColorIn(text, "Kd");
  EXPECT_NEAR(kd[0], 1 - .092, .002);
  EXPECT_NEAR(kd[1], .908 * .404 * .5 / (1 - .596 * .5), .002);
  EXPECT_EQ(kd[2], 0);
  EXPECT_EQ(ColorIn(text, "Kr")[0], 1);
  EXPECT_EQ(ColorIn(Material4("Material \"coateddiffuse\" \"float roughness\" .1"), "Kr")[0], 0);
}

TEST(Import, SubsurfaceReflectsWhatItsMediumReflects) {
  const auto red = [](const std::string& material) { return ColorIn(material, "Kd")[0]; };
  const std::string head = "Material \"subsurface\" ";
  EXPECT_NEAR(red(Material3(head)), .9039, 1e-4);
  EXPECT_NEAR(red(Material4(head + "\"string name\" \"Skin1\" \"float g\" .5")), .4276, 1e-4);
  EXPECT_NEAR(red(Material4(head + "\"rgb sigma_a\" [1 1 1] \"rgb sigma_s\" [6 6 6] "
                                   "\"float g\" .5 \"float eta\" 1.5 \"float scale\" 7")),
              .1594, 1e-4);
  EXPECT_NEAR(red(Material4(head + "\"rgb reflectance\" [.3 .3 .3]")), .3, 1e-12);
  const Imported unknown = World4(head + "\"string name\" \"Tea\"");
  EXPECT_NEAR(red(LastMaterial(unknown)), .9039, 1e-4);
  EXPECT_NE(unknown.text.find("parameter \"name\" is no known medium: \"Wholemilk\""),
            std::string::npos)
      << unknown.text;
}

TEST(Import, GlossGrowsWithRoughnessAndHasTheWidthOfTheLobe) {
  EXPECT_DOUBLE_EQ(GlossOf(.5, false, 3), .25 / 1.5);  // e = 2 / alpha^2 - 2 = 6
  EXPECT_DOUBLE_EQ(GlossOf(.25, true, 4), .25 / 1.5);  // alpha is the root
  double last = 0;
  for (const double roughness : {.001, .01, .1, .3, .9}) {
    EXPECT_GT(GlossOf(roughness, true, 3), last);
    last = GlossOf(roughness, true, 3);
  }
}

TEST(Import, ConvertsLightsWithTheirUnits) {
  EXPECT_EQ(World3("LightSource \"point\" \"rgb I\" [1 2 3] \"rgb scale\" [2 2 .5]").Line("Light"),
            "LightSource \"point\" \"color I\" [2 4 1.5]");
  const auto ofPower = [](const std::string& text) {
    const std::string line = World4(text).Line("LightSource");
    return std::strtod(line.c_str() + line.find('[') + 1, nullptr);
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(ofPower("LightSource \"point\" \"float power\" 100"), 100 / (4 * pi), 1e-12);
  EXPECT_NEAR(ofPower("LightSource \"distant\" \"float illuminance\" 7"), 7, 1e-12);
  EXPECT_NEAR(ofPower("LightSource \"infinite\" \"float illuminance\" 7"), 7 / pi, 1e-12);
  // A cone of 90 degrees without a rim is a hemisphere.
  EXPECT_NEAR(ofPower("LightSource \"spot\" \"float coneangle\" 90 \"float conedeltaangle\" 0 "
                      "\"float power\" 10"),
              10 / (2 * pi), 1e-12);
  // A rim that falls off by a quartic emits a fifth of the same solid angle at full intensity.
  EXPECT_NEAR(ofPower("LightSource \"spot\" \"float coneangle\" 90 \"float conedeltaangle\" 90 "
                      "\"float power\" 10"),
              10 / (2 * pi / 5), 1e-12);
  EXPECT_EQ(World4("AreaLightSource \"diffuse\" \"rgb L\" [1 2 3] \"float scale\" 2").Line("Area"),
            "AreaLightSource \"area\" \"color L\" [2 4 6]");
}

TEST(Import, QuotesTextSoThatItIsReadBack) {
  const std::string name = "a\r\n\r\t\"\\\b\fz\xc3";
  const std::vector<Directive> read = ParseText("CoordinateSystem " + QuotedText(name));
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].strings[0], name);
}

// Version 3 has the quartic of version 1.
TEST(Import, ReportsTheSmoothRimOfASpotOfVersion4) {
  const Imported four = World4("LightSource \"spot\"");
  EXPECT_FALSE(four.isExact);
  EXPECT_NE(four.messages.find("LightSource \"spot\" falls off by a quartic"), std::string::npos)
      << four.messages;
  EXPECT_TRUE(World4("LightSource \"spot\" \"float conedeltaangle\" 0").isExact);
  EXPECT_TRUE(World3("LightSource \"spot\"").isExact);
}

// The full light ends at 3 - 5 degrees, which has the cosine of 2 degrees.
TEST(Import, KeepsTheRimOfASpotWithinItsCone) {
  const Imported narrow = World3("LightSource \"spot\" \"float coneangle\" 3");
  EXPECT_NE(narrow.Line("LightSource").find("\"float coneangle\" [3] \"float conedeltaangle\" [1]"),
            std::string::npos)
      << narrow.Line("LightSource");
  const Imported narrower = World3("LightSource \"spot\" \"float coneangle\" 2");
  EXPECT_NE(narrower.Line("LightSource").find("\"float conedeltaangle\" [0]"), std::string::npos);
}

TEST(Import, EndsTheSincFilterAtTau) {
  const auto convert = [](const std::string& film, const std::string& parameters) {
    return ImportText("Film \"" + film + "\"\nIntegrator \"path\"\nPixelFilter \"sinc\" " +
                      parameters + "\nSampler \"halton\"\nWorldBegin\n" +
                      (film == "rgb" ? "" : "WorldEnd\n"));
  };
  const std::string two =
      "PixelFilter \"sinc\" \"float xwidth\" [2] \"float ywidth\" [2] \"float tau\" [2]";
  for (const Imported& exact :
       {convert("rgb", "\"float xradius\" 2 \"float yradius\" 2 \"float tau\" 2"),
        convert("image", "\"float xwidth\" 2 \"float ywidth\" 2 \"float tau\" 2")}) {
    EXPECT_EQ(exact.Line("PixelFilter"), two);
    EXPECT_TRUE(exact.isExact) << exact.messages;
  }
  // The default radius is 4.
  const Imported longer = convert("rgb", "\"float tau\" 2 \"float yradius\" 2");
  EXPECT_EQ(longer.Line("PixelFilter"), two);
  EXPECT_FALSE(longer.isExact);
  EXPECT_NE(longer.messages.find("PixelFilter \"sinc\" ends at its \"tau\" of 2 pixels, and not at "
                                 "its radius of 4 and 2"),
            std::string::npos)
      << longer.messages;
}

TEST(Import, BlackbodyOfVersion4HasLuminance1) {
  for (const int kelvin : {2000, 4000, 9000}) {
    const auto c = ColorIn(
        World4("LightSource \"point\" \"blackbody I\" " + std::to_string(kelvin)).text, "I");
    EXPECT_NEAR(.212671 * c[0] + .71516 * c[1] + .072169 * c[2], 1, 1e-6);
  }
}

TEST(Import, ExposureOfTheFilmMultipliesTheLights) {
  const std::string lights = "LightSource \"distant\"\nAreaLightSource \"diffuse\"\n";
  const Imported four = ImportText(
      "Film \"rgb\" \"float iso\" 200 \"float exposuretime\" .25\nWorldBegin\n" + lights);
  EXPECT_EQ(four.Line("LightSource"), "LightSource \"distant\" \"color L\" [0.5 0.5 0.5]");
  EXPECT_EQ(four.Line("AreaLightSource"), "AreaLightSource \"area\" \"color L\" [0.5 0.5 0.5]");
  const Imported three =
      ImportText("Film \"image\" \"float scale\" 3\nIntegrator \"path\"\nWorldBegin\n" + lights +
                 "WorldEnd\n");
  EXPECT_EQ(three.Line("LightSource"), "LightSource \"distant\" \"color L\" [3 3 3]");
}

TEST(Import, ConvertsShapes) {
  EXPECT_EQ(World4("Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]").Line("Shape"),
            "Shape \"trianglemesh\" \"integer indices\" [0 1 2] "
            "\"point P\" [0 0 0 1 0 0 0 1 0]");
  EXPECT_EQ(World3("Shape \"loopsubdiv\" \"integer levels\" 2 \"integer indices\" [0 1 2] "
                   "\"point P\" [0 0 0 1 0 0 0 1 0]")
                .Line("Shape"),
            "Shape \"loopsubdiv\" \"integer nlevels\" [2] \"integer indices\" [0 1 2] "
            "\"point P\" [0 0 0 1 0 0 0 1 0]");
  const std::string flat = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 ";
  EXPECT_TRUE(World4(flat + "0]").isExact);
  EXPECT_FALSE(World4(flat + ".5]").isExact);
  EXPECT_NE(World4(flat + "0]").text.find("[0 1 3 0 3 2]"), std::string::npos);
}

// In versions 3 and 4 the normals of the vertices decide which side of an area light shines.
TEST(Import, TurnsShiningTrianglesToTheirNormals) {
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0] "
      "\"normal N\" [0 0 -1 0 0 -1 0 0 -1]\n";
  EXPECT_NE(World3("AreaLightSource \"diffuse\"\n" + mesh).text.find("[0 2 1]"), std::string::npos);
  EXPECT_NE(World3(mesh).text.find("[0 1 2]"), std::string::npos);
}

TEST(Import, TurnsImagesUpsideDown) {
  const std::string line =
      World3(
          "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" "
          "\"float vscale\" 2 \"float vdelta\" .25")
          .Line("Texture");
  EXPECT_NE(line.find("\"float vscale\" [-2] \"float vdelta\" [0.75]"), std::string::npos) << line;
}

TEST(Import, DecodesImagesAsTheSceneSays) {
  const auto gammaOf = [](const std::string& rest) {
    const std::string line =
        World4("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" " + rest)
            .Line("Texture");
    const std::size_t at = line.find("\"float gamma\"");
    return at == std::string::npos ? "" : line.substr(at);
  };
  EXPECT_EQ(gammaOf("\"a.png\""), "");
  EXPECT_EQ(gammaOf("\"a.png\" \"string encoding\" \"linear\""), "\"float gamma\" [1]");
  EXPECT_EQ(gammaOf("\"a.png\" \"string encoding\" \"gamma 2\" \"float scale\" 9"),
            "\"float gamma\" [2] \"float scale\" [3]");
  EXPECT_EQ(gammaOf("\"a.exr\" \"string encoding\" \"linear\""), "");
}

}  // namespace
}  // namespace exphoton::cli
