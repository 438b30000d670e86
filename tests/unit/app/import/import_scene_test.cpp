// SPDX-License-Identifier: BSD-2-Clause
// These tests convert whole scenes of versions 3 and 4. Everything that is not exact is listed.
#include <gtest/gtest.h>

#include "tests/unit/app/import/import_support.h"

namespace exphoton::cli {
namespace {

BuiltScene BuildStrictly(const std::string& text) {
  LoadOptions options;
  options.isStrict = true;
  return BuildText(text, options);
}

TEST(Import, WritesTheDefaultsOfTheLaterVersions) {
  const Imported three = ImportText("Integrator \"path\"\nWorldBegin\nWorldEnd\n");
  EXPECT_EQ(three.version, 3);
  EXPECT_NE(three.Line("Film").find("\"integer xresolution\" [1280]"), std::string::npos);
  EXPECT_EQ(three.Line("PixelFilter"),
            "PixelFilter \"box\" \"float xwidth\" [0.5] \"float ywidth\" [0.5]");
  EXPECT_EQ(three.Line("SurfaceIntegrator"), "SurfaceIntegrator \"path\" \"integer maxdepth\" [4]");
  EXPECT_EQ(three.Line("Sampler"), "Sampler \"halton\" \"integer pixelsamples\" [16]");
  EXPECT_EQ(three.Line("Material"), "Material \"matte\" \"color Kd\" [0.5 0.5 0.5]");
  EXPECT_TRUE(three.isExact) << three.messages;
  const Imported four = ImportText("Integrator \"volpath\"\nWorldBegin\n");
  EXPECT_EQ(four.version, 4);
  EXPECT_NE(four.Line("PixelFilter").find("\"float alpha\" [2]"), std::string::npos);
  EXPECT_EQ(four.Count("WorldEnd"), 1);
}

TEST(Import, KeepsTheViewOfLookAt) {
  const Imported plain = ImportText("LookAt 0 0 -5 0 0 0 0 1 0\n" + kHead4);
  EXPECT_NE(plain.text.find("Scale -1 1 1\nLookAt 0 0 -5 0 0 0 0 1 0\n"), std::string::npos);
  EXPECT_EQ(plain.Line("Renderer"), "");
}

TEST(Import, NamesFilesRelativeToTheNewScene) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  ImportReport report(log);
  MemorySource source(
      {{"in/scene.pbrt", kHead4 + "Shape \"plymesh\" \"string filename\" \"a.ply\""}});
  const ImportedScene scene =
      ImportScene(source, {"in/scene.pbrt", "out/new.pbrt", {}, {}}, report, log);
  EXPECT_NE(scene.text.find("\"string filename\" [\"../in/a.ply\"]"), std::string::npos)
      << scene.text;
  EXPECT_FALSE(report.IsExact()) << "the file does not exist";
}

TEST(Import, UsesMaterialsAndTexturesOfVersion4BeforeTheirDefinition) {
  const Imported imported = World4(
      "NamedMaterial \"m\"\nShape \"sphere\"\nAttributeBegin\n"
      "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [.1 .2 .3]\n"
      "MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"texture reflectance\" \"t\"\n"
      "AttributeEnd\n");
  EXPECT_TRUE(imported.isExact) << imported.messages;
  const std::size_t texture = imported.text.find("Texture \"t\"");
  const std::size_t material = imported.text.find("Material \"matte\" \"texture Kd\" [\"t\"]");
  ASSERT_NE(texture, std::string::npos);
  ASSERT_NE(material, std::string::npos);
  EXPECT_LT(texture, material);
  EXPECT_EQ(imported.Count("MakeNamedMaterial"), 0);
}

TEST(Import, EndsNamedMaterialsOfVersion3WithTheirBlock) {
  const std::string define = "MakeNamedMaterial \"m\" \"string type\" \"mirror\"\n";
  EXPECT_EQ(World3("AttributeBegin\n" + define + "NamedMaterial \"m\"\nAttributeEnd\n").error, "");
  const std::string error =
      World3("AttributeBegin\n" + define + "AttributeEnd\nNamedMaterial \"m\"\n").error;
  EXPECT_TRUE(error.starts_with("scene.pbrt:9:1: error: there is no material of the name \"m\"\n"))
      << error;
}

TEST(Import, BlendsNeedVersion2) {
  const std::string blend =
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
      "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [.1 .1 .1]\n"
      "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .25\n"
      "Shape \"sphere\"\n";
  const Imported four = ImportText("LookAt 0 0 -5 0 0 0 0 1 0\n" + kHead4 + blend);
  EXPECT_EQ(four.Line("Renderer \"sampler\"").substr(0, 18), "Renderer \"sampler\"");
  EXPECT_EQ(four.Count("Scale -1 1 1"), 0);
  EXPECT_NE(four.text.find("\"color amount\" [0.25 0.25 0.25]"), std::string::npos);
  EXPECT_NE(four.text.find("\"string namedmaterial1\" [\"b\"] \"string namedmaterial2\" [\"a\"]"),
            std::string::npos)
      << four.text;
  const BuiltScene built = BuildStrictly(four.text);
  EXPECT_EQ(built.error, "");
}

TEST(Import, ListsWhatIsLeftOutWithItsPlace) {
  const Imported imported = World4(
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "Shape \"curve\"\n"
      "Material \"hair\"\n"
      "  LightSource \"goniometric\"\n"
      "Shape \"sphere\" \"float alpha\" .5\n"
      "Material \"diffuse\" \"string normalmap\" \"n.png\"\n");
  EXPECT_FALSE(imported.isExact);
  for (const char* line :
       {"#   scene.pbrt:6:1: MakeNamedMedium \"fog\" is left out: a Volume in a box can take its "
        "place\n",
        "#   scene.pbrt:7:1: Shape \"curve\" is left out\n",
        "#   scene.pbrt:8:1: Material \"hair\" is replaced by \"matte\": there is no material "
        "\"hair\" here\n",
        "#   scene.pbrt:9:3: LightSource \"goniometric\" is left out\n",
        "#   scene.pbrt:10:16: Shape \"sphere\": parameter \"alpha\" is left out: this shape has "
        "no "
        "holes here\n",
        "#   scene.pbrt:11:20: Material \"diffuse\": parameter \"normalmap\" is left out\n"})
    EXPECT_NE(imported.text.find(line), std::string::npos) << line << imported.text;
  EXPECT_NE(imported.messages.find("scene.pbrt:7:1: warning: Shape \"curve\" is left out"),
            std::string::npos);
}

TEST(Import, LeavesOutSurfacesThatOnlyBoundMedia) {
  const Imported four = World4(
      "AttributeBegin\nMaterial \"interface\"\nShape \"sphere\"\nAttributeEnd\nShape \"disk\"\n");
  EXPECT_TRUE(four.isExact) << four.messages;
  EXPECT_EQ(four.Line("Shape"), "Shape \"disk\"");
  EXPECT_FALSE(
      World4("Material \"interface\"\nAreaLightSource \"diffuse\"\nShape \"sphere\"\n").isExact);
}

TEST(Import, TakesParametersOfAttributeInAdvance) {
  const Imported imported = World4(
      "AttributeBegin\nAttribute \"shape\" \"float radius\" 3\n"
      "Attribute \"light\" \"float scale\" 2\n"
      "Shape \"sphere\"\nShape \"disk\" \"float radius\" 5\nLightSource \"point\"\nAttributeEnd\n"
      "Shape \"sphere\"\n");
  EXPECT_TRUE(imported.isExact) << imported.messages;
  EXPECT_EQ(imported.Count("Shape \"sphere\" \"float radius\" [3]"), 1);
  EXPECT_EQ(imported.Count("Shape \"disk\" \"float radius\" [5]"), 1);
  EXPECT_EQ(imported.Count("Shape \"sphere\"\n"), 1);
  EXPECT_EQ(imported.Count("\"color I\" [2 2 2]"), 1);
}

TEST(Import, MakesImportedFilesPartOfTheScene) {
  const Imported imported =
      ImportFiles({{"scene.pbrt", kHead4 + "Import \"part.pbrt\"\nShape \"sphere\"\n"},
                   {"part.pbrt", "Translate 1 2 3\nInclude \"more.pbrt\"\n"},
                   {"more.pbrt", "Shape \"disk\" \"bool hidden\" true\n"}});
  EXPECT_EQ(imported.error, "");
  EXPECT_NE(imported.text.find("AttributeBegin\n  Translate 1 2 3\n  Shape \"disk\"\nAttributeEnd\n"
                               "Shape \"sphere\"\n"),
            std::string::npos)
      << imported.text;
  EXPECT_NE(ImportFiles({{"scene.pbrt", kHead4 + "Import \"scene.pbrt\"\n"}}).error.find("itself"),
            std::string::npos);
}

TEST(Import, RefusesWhatItCannotRead) {
  EXPECT_NE(ImportText("SurfaceIntegrator \"path\"\nWorldBegin\n")
                .error.find("1:1: error: versions 3 and 4 have no directive SurfaceIntegrator"),
            std::string::npos);
  EXPECT_NE(ImportText("Shape \"sphere\"\n").error.find("there is no WorldBegin"),
            std::string::npos);
  EXPECT_NE(World4("AttributeBegin\n").error.find("a block is open"), std::string::npos);
  EXPECT_NE(World4("AttributeEnd\n").error.find("ends no block"), std::string::npos);
  EXPECT_NE(
      World4("Shape \"bilinearmesh\" \"point P\" [0 0 0]").error.find("index without a vertex"),
      std::string::npos);
  EXPECT_NE(World4("LightSource \"point\" \"blackbody I\" -5").error.find("takes a temperature"),
            std::string::npos);
  EXPECT_NE(World4("MakeNamedMaterial \"m\"").error.find("needs the class"), std::string::npos);
  EXPECT_NE(World4("Shape \"bilinearmesh\" \"integer indices\" [0 1 2 1e30] \"point P\" [0 0 0]")
                .error.find("index without a vertex"),
            std::string::npos);
  EXPECT_NE(World4("Scale 0 1 1").error.find("Scale: a factor is 0"), std::string::npos);
}

constexpr const char* kTour3 =
    "Scale -1 1 1\nLookAt 0 1 -5 0 1 0 0 1 0\nCamera \"perspective\" \"float fov\" 50\n"
    "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
    "Sampler \"02sequence\" \"integer pixelsamples\" 4\nIntegrator \"bdpt\"\n"
    "PixelFilter \"mitchell\"\nAccelerator \"bvh\" \"string splitmethod\" \"hlbvh\"\nWorldBegin\n"
    "Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.8 .2 .2] \"float uscale\" 8\n"
    "Texture \"s\" \"color\" \"scale\" \"texture tex1\" \"c\" \"rgb tex2\" [.5 .5 .5]\n"
    "Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"s\" \"rgb tex2\" [.1 .1 .1]\n"
    "Texture \"f\" \"float\" \"fbm\" \"integer octaves\" 4\n"
    "LightSource \"point\" \"blackbody I\" [3000 5]\nLightSource \"spot\"\n"
    "LightSource \"distant\" \"spectrum L\" [400 1 700 2]\nLightSource \"infinite\"\n"
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"integer nsamples\" 4\n"
    "Shape \"disk\" \"float height\" 3\nAttributeEnd\n"
    "Material \"matte\" \"texture Kd\" \"m\" \"texture bumpmap\" \"f\"\nShape \"sphere\"\n"
    "Material \"plastic\"\nShape \"cylinder\"\nMaterial \"metal\" \"float roughness\" .1\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0] "
    "\"float uv\" [0 0 1 0 0 1] \"normal N\" [0 0 1 0 0 1 0 0 1]\n"
    "Material \"glass\"\nShape \"sphere\" \"float radius\" .5\nMaterial \"uber\"\n"
    "Shape \"loopsubdiv\" \"integer indices\" [0 1 2 0 2 3 0 3 1 1 3 2] "
    "\"point P\" [0 0 0 1 0 0 0 1 0 0 0 1]\nMaterial \"substrate\"\nShape \"cone\"\n"
    "Material \"translucent\"\nShape \"paraboloid\"\n"
    "ObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\nTranslate 1 0 0\nObjectInstance \"o\"\n"
    "TransformBegin\nRotate 20 0 1 0\nCoordinateSystem \"here\"\nTransformEnd\n"
    "CoordSysTransform \"here\"\nReverseOrientation\nShape \"sphere\"\nWorldEnd\n";

constexpr const char* kTour4 =
    "Scale -1 1 1\nLookAt 0 1 -5 0 1 0 0 1 0\nCamera \"perspective\" \"float fov\" 50\n"
    "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
    "Sampler \"zsobol\" \"integer pixelsamples\" 4\nIntegrator \"volpath\"\n"
    "PixelFilter \"gaussian\" \"float xradius\" 2\nColorSpace \"srgb\"\nWorldBegin\n"
    "Texture \"c\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.8 .2 .2] \"float uscale\" 8\n"
    "Texture \"s\" \"spectrum\" \"scale\" \"texture tex\" \"c\" \"float scale\" .5\n"
    "Texture \"m\" \"spectrum\" \"mix\" \"texture tex1\" \"s\" \"rgb tex2\" [.1 .1 .1]\n"
    "AttributeBegin\nTranslate 1 2 3\n"
    "Texture \"f\" \"float\" \"fbm\" \"integer octaves\" 4\nAttributeEnd\n"
    "LightSource \"point\" \"spectrum I\" \"stdillum-A\" \"float power\" 30\n"
    "LightSource \"infinite\" \"rgb L\" [.1 .1 .2]\n"
    "AttributeBegin\nAreaLightSource \"diffuse\" \"blackbody L\" 3000 \"bool twosided\" false\n"
    "Shape \"disk\" \"float height\" 3\nAttributeEnd\n"
    "Material \"diffuse\" \"texture reflectance\" \"m\" \"texture displacement\" \"f\"\n"
    "Shape \"sphere\"\nMaterial \"coateddiffuse\" \"float roughness\" .1\nShape \"sphere\"\n"
    "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" "
    "\"float roughness\" .1\nShape \"sphere\"\nMaterial \"coatedconductor\"\nShape \"sphere\"\n"
    "Material \"dielectric\"\nShape \"sphere\"\nMaterial \"thindielectric\"\nShape \"sphere\"\n"
    "Material \"diffusetransmission\"\n"
    "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n"
    "MakeNamedMaterial \"n\" \"string type\" \"diffuse\"\nNamedMaterial \"n\"\n"
    "ObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\nTranslate 1 0 0\nObjectInstance \"o\"\n";

TEST(Import, ConvertedScenesLoadUnderStrict) {
  for (const char* text : {kTour3, kTour4}) {
    const Imported imported = ImportText(text);
    ASSERT_EQ(imported.error, "");
    const BuiltScene built = BuildStrictly(imported.text);
    EXPECT_EQ(built.error, "") << imported.text;
    EXPECT_EQ(built.setups.size(), 1u);
    EXPECT_EQ(built.log->WarningCount(), 0) << built.Messages();
  }
  EXPECT_TRUE(ImportText(kTour3).isExact) << ImportText(kTour3).messages;
}

// A broken text gives an error or a scene, never a crash.
TEST(Import, SurvivesBrokenTexts) {
  int errors = 0, scenes = 0;
  for (const std::string whole : {kTour3, kTour4}) {
    std::uint32_t random = 1;
    for (std::size_t i = 0; i < whole.size(); i += 3) {
      std::string cut = whole.substr(0, i), changed = whole;
      random = random * 1664525 + 1013904223;
      changed[i] = "\"[]# 0-9aZ\n"[(random >> 16) % 11];
      for (const std::string& text : {cut, changed}) {
        const Imported imported = ImportText(text);
        ++(imported.error.empty() ? scenes : errors);
        EXPECT_EQ(imported.error.empty(), !imported.text.empty());
      }
    }
  }
  EXPECT_GT(errors, 500);
  EXPECT_GT(scenes, 200);
}

TEST(Import, PlacesTexturesOfVersion4InTheirSpace) {
  const Imported imported = ImportText(kTour4);
  EXPECT_NE(imported.text.find("TransformBegin\nTransform [1 0 0 0 0 1 0 0 0 0 1 0\n  1 2 3 1]\n"
                               "Texture \"f\""),
            std::string::npos)
      << imported.text;
}

}  // namespace
}  // namespace exphoton::cli
