// SPDX-License-Identifier: BSD-2-Clause
// These tests check the meaning of scenes: blocks, transformations, materials, textures, objects
// and defaults. They also check the messages for misplaced directives.
#include <gtest/gtest.h>

#include "core/scattering/material.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

struct BuilderCase {
  std::string text;
  const char* message;
};

void PrintTo(const BuilderCase& c, std::ostream* out) { *out << c.text.substr(0, 200); }

// Returns "line:column: text | hint" of the error that building the scene reports.
std::string ShortErrorOf(const std::string& text, LoadOptions options = {}) {
  Log log(Log::Level::Normal, Log::Sink::Memory);
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  MemorySource source({{"scene.pbrt", text}});
  try {
    LoadScenes(source, "scene.pbrt", options, log);
  } catch (const Error& error) {
    EXPECT_TRUE(error.Where()) << error.what();
    std::string said = std::to_string(error.Where()->line) + ":" +
                       std::to_string(error.Where()->column) + ": " + error.what();
    return error.Hint().empty() ? said : said + " | " + error.Hint();
  }
  return "";
}

class SceneError : public testing::TestWithParam<BuilderCase> {};
TEST_P(SceneError, IsSaidInTheseWords) {
  EXPECT_EQ(ShortErrorOf(GetParam().text), GetParam().message);
}

const std::string kBegin = "Accelerator \"bruteforce\" WorldBegin\n";

INSTANTIATE_TEST_SUITE_P(
    OutOfPlace, SceneError,
    testing::Values(
        BuilderCase{"", "1:1: the file has no WorldBegin: there is nothing to render"},
        BuilderCase{"# only\nIdentity\n",
                    "3:1: the file has no WorldBegin: there is nothing to render"},
        BuilderCase{"WorldEnd", "1:1: WorldEnd without WorldBegin"},
        BuilderCase{kBegin + "Identity\n",
                    "3:1: WorldEnd is missing: the world begins at scene.pbrt:1"},
        BuilderCase{kBegin + "WorldBegin",
                    "2:1: WorldBegin inside the world that begins at scene.pbrt:1"},
        BuilderCase{"Shape \"sphere\"", "1:1: Shape must be between WorldBegin and WorldEnd"},
        BuilderCase{"AttributeBegin",
                    "1:1: AttributeBegin must be between WorldBegin and WorldEnd"},
        BuilderCase{kBegin + "Camera \"perspective\"", "2:1: Camera must be before WorldBegin"},
        BuilderCase{kBegin + "SearchPath \"x\"", "2:1: SearchPath must be before WorldBegin"},
        BuilderCase{kBegin + "AttributeEnd", "2:1: AttributeEnd without AttributeBegin"},
        BuilderCase{kBegin + "TransformEnd", "2:1: TransformEnd without TransformBegin"},
        BuilderCase{kBegin + "ObjectEnd", "2:1: ObjectEnd without ObjectBegin"},
        BuilderCase{kBegin + "AttributeBegin TransformEnd",
                    "2:16: TransformEnd does not match the AttributeBegin at scene.pbrt:2"},
        BuilderCase{kBegin + "ObjectBegin \"a\" AttributeEnd",
                    "2:17: AttributeEnd does not match the ObjectBegin at scene.pbrt:2"},
        BuilderCase{kBegin + "ObjectBegin \"a\"\nObjectBegin \"b\"",
                    "3:1: ObjectBegin inside the object that begins at scene.pbrt:2"},
        BuilderCase{kBegin + "ObjectBegin \"a\"\nWorldEnd",
                    "3:1: the object that begins at scene.pbrt:2 has no ObjectEnd"}));

INSTANTIATE_TEST_SUITE_P(
    Names, SceneError,
    testing::Values(
        BuilderCase{"CoordSysTransform \"camera\"",
                    "1:1: no coordinate system \"camera\" has been named"},
        BuilderCase{"CoordinateSystem \"here\" CoordSysTransform \"hree\"",
                    "1:25: no coordinate system \"hree\" has been named | did you mean \"here\"?"},
        BuilderCase{kBegin + "ObjectInstance \"a\"", "2:1: no object \"a\" has been defined"},
        BuilderCase{kBegin + "ObjectBegin \"table\" ObjectEnd ObjectInstance \"tabel\"",
                    "2:31: no object \"tabel\" has been defined | did you mean \"table\"?"},
        BuilderCase{kBegin + "ObjectBegin \"a\" ObjectInstance \"a\"",
                    "2:17: object \"a\" contains an instance of itself"},
        BuilderCase{kBegin + "ObjectBegin \"a\" ObjectEnd ObjectBegin \"b\" ObjectInstance \"a\"",
                    "2:43: an object cannot contain instances of other objects"},
        BuilderCase{kBegin + "NamedMaterial \"m\"", "2:1: no material \"m\" has been defined"},
        BuilderCase{
            kBegin + "MakeNamedMaterial \"m\" \"color Kd\" [1 1 1]",
            "2:1: MakeNamedMaterial \"m\" needs a parameter \"string type\" with the material's "
            "name"},
        BuilderCase{kBegin + "Texture \"t\" \"colour\" \"constant\"",
                    "2:1: texture \"t\" has type \"colour\"; types of textures are \"float\" and "
                    "\"color\""},
        BuilderCase{"Film \"rgbx\"", "1:1: unknown film \"rgbx\"; known: \"image\""},
        BuilderCase{"Renderer \"metropolitan\"",
                    "1:1: unknown renderer \"metropolitan\"; known: \"sampler\", \"metropolis\", "
                    "\"createprobes\", \"surfacepoints\", \"aggregatetest\" | did you mean "
                    "\"metropolis\"?"},
        BuilderCase{
            "ActiveTransform Alll",
            "1:1: unknown time \"Alll\" of ActiveTransform; known: All, StartTime, EndTime | did "
            "you mean \"All\"?"}));

INSTANTIATE_TEST_SUITE_P(
    Transformations, SceneError,
    testing::Values(BuilderCase{"Scale 0 1 1", "1:1: Scale: a factor is 0"},
                    BuilderCase{"Rotate 10 0 0 0", "1:1: Rotate: the axis is 0 0 0"},
                    BuilderCase{"LookAt 1 1 1 1 1 1 0 1 0",
                                "1:1: LookAt: the eye is the point that it looks at, "
                                "or \"up\" is parallel to the direction of "
                                "view"},
                    BuilderCase{"LookAt 0 0 0 0 5 0 0 1 0",
                                "1:1: LookAt: the eye is the point that it looks at, "
                                "or \"up\" is parallel to the direction of "
                                "view"},
                    BuilderCase{"Transform [1 0 0 0 2 0 0 0 0 0 1 0 0 0 0 1]",
                                "1:1: Transform: the matrix is "
                                "singular"},
                    BuilderCase{"ConcatTransform [0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0]",
                                "1:1: ConcatTransform: the matrix is singular"}));

TEST(SceneBuilder, RefusesAMillionNestedBlocksWithoutOverflow) {
  std::string text = kBegin;
  for (int i = 0; i < 1'000'000; ++i) text += "AttributeBegin\n";
  EXPECT_EQ(ShortErrorOf(text), "4098:1: blocks are nested more than 4096 deep");
}

TEST(SceneBuilder, RefusesTransformationsThatOverflow) {
  std::string text;
  for (int i = 0; i < 12; ++i) text += "Scale 1e30 1e30 1e30\n";
  EXPECT_EQ(ShortErrorOf(text), "11:1: Scale: the transformation overflows");
}

TEST(SceneBuilder, FillsInTheDefaultsOfVersion1) {
  const BuiltScene built = BuildText("Accelerator \"bruteforce\" WorldBegin WorldEnd");
  ASSERT_EQ(built.error, "");
  ASSERT_EQ(built.setups.size(), 1u);
  const RenderSetup& setup = *built.setups[0];
  EXPECT_EQ(setup.filterName, "mitchell");
  EXPECT_EQ(setup.cameraName, "perspective");
  EXPECT_EQ(setup.integratorName, "directlighting");
  EXPECT_EQ(setup.samplerName, "lowdiscrepancy");
  EXPECT_EQ(setup.sampler->SamplesPerPixel(), 4);
  EXPECT_EQ(setup.film.filename, "pbrt.exr");
  EXPECT_EQ(setup.crop, (PixelBounds{0, 0, 640, 480}));
  EXPECT_EQ(built.Messages().find("bestcandidate"), std::string::npos);
}

TEST(SceneBuilder, LetsTheLastOfEachOptionWin) {
  const BuiltScene built = BuildText(
      "Film \"image\" \"integer xresolution\" 10\nFilm \"image\" \"integer yresolution\" 7\n"
      "SurfaceIntegrator \"path\"\nSurfaceIntegrator \"whitted\"\n" +
      kBegin + "WorldEnd");
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->crop, (PixelBounds{0, 0, 640, 7}));
  EXPECT_EQ(built.setups[0]->integratorName, "whitted");
}

TEST(SceneBuilder, MakesOneSetupForEachWorldAndResetsBetween) {
  const BuiltScene built =
      BuildText("Film \"image\" \"integer xresolution\" 10\nTranslate 1 2 3\n" + kBegin +
                "WorldEnd\n" + kBegin + "CoordSysTransform \"camera\"\nWorldEnd\n");
  ASSERT_EQ(built.error, "");
  ASSERT_EQ(built.setups.size(), 2u);
  EXPECT_EQ(built.setups[0]->film.xResolution, 10);
  EXPECT_EQ(built.setups[1]->film.xResolution, 640);
  EXPECT_TRUE(built.setups[1]->camera->CameraToWorld().IsIdentity());
}

TEST(SceneBuilder, TakesTheMatrixAtCameraForWorldToCamera) {
  const BuiltScene built =
      BuildText("Translate 1 2 3\nCamera \"perspective\"\nTranslate 9 9 9\n" + kBegin +
                "CoordSysTransform \"camera\" Shape \"sphere\" \"float radius\" .5\nWorldEnd");
  ASSERT_EQ(built.error, "");
  const Point3 origin = built.setups[0]->camera->CameraToWorld().ApplyPoint({0, 0, 0});
  EXPECT_EQ(origin, Point3(-1, -2, -3));
  EXPECT_NEAR(double(built.setups[0]->scene->WorldBounds().Center().z), -3, 1e-4);
}

TEST(SceneBuilder, MirrorsLookAtInTheDialectOfVersion2) {
  LoadOptions v2;
  v2.dialect = Dialect::V2;
  const std::string text =
      "LookAt 0 0 -5 0 0 0 0 1 0\nCamera \"perspective\"\n" + kBegin + "WorldEnd";
  const BuiltScene one = BuildText(text), two = BuildText(text, v2);
  ASSERT_EQ(one.error + two.error, "");
  const Vector3 x1 = one.setups[0]->camera->CameraToWorld().ApplyVector({1, 0, 0});
  const Vector3 x2 = two.setups[0]->camera->CameraToWorld().ApplyVector({1, 0, 0});
  EXPECT_EQ(x1, -x2);
  EXPECT_EQ(one.setups[0]->camera->CameraToWorld().ApplyPoint({0, 0, 5}), Point3(0, 0, 0));
  EXPECT_EQ(two.setups[0]->camera->CameraToWorld().ApplyPoint({0, 0, 5}), Point3(0, 0, 0));
}

TEST(SceneBuilder, BringsBackTheStateAtTheEndOfABlock) {
  // The sphere lies at the origin with radius 1, because both blocks restore the transformation.
  const BuiltScene built = BuildText(InWorld(
      "AttributeBegin Scale 100 100 100 AttributeEnd TransformBegin Translate 50 0 0 TransformEnd\n"
      "Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_NEAR(double(built.setups[0]->scene->WorldBounds().max.x), 1, 1e-3);
}

TEST(SceneBuilder, GivesTransformBlocksBackOnlyTheTransformation) {
  const BuiltScene built =
      BuildText(InWorld("TransformBegin AreaLightSource \"area\" TransformEnd Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->Lights().size(), 1u);
}

TEST(SceneBuilder, PutsAnAreaLightOnEachShapeOfItsBlockOnly) {
  const BuiltScene built = BuildText(InWorld(
      "AttributeBegin AreaLightSource \"area\" Shape \"sphere\" Shape \"trianglemesh\" \"integer "
      "indices\" [0 1 2 0 2 3] \"point P\" [0 0 0 1 0 0 1 1 0 0 1 0] AttributeEnd Shape \"disk\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->Lights().size(), 2u);  // one light for the whole mesh
}

TEST(SceneBuilder, MakesOneMaterialForAllTheShapesThatUseIt) {
  const BuiltScene built = BuildText(InWorld(
      "Material \"matte\" Shape \"sphere\" Shape \"disk\" Material \"mirror\" Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->Materials().size(), 2u);
}

TEST(SceneBuilder, LetsAShapeOverrideItsMaterialsParameters) {
  const BuiltScene built =
      BuildText(InWorld("Material \"plastic\" \"color Kd\" [0 0 0]\nShape \"sphere\" \"color Ks\" "
                        "[0 0 0] \"float radius\" 2"));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.Messages().find("unknown parameter"), std::string::npos) << built.Messages();
  EXPECT_FALSE(Any(built.setups[0]->scene->Materials().back()->PossibleLobes()));
}

TEST(SceneBuilder, WarnsOfAParameterThatNeitherShapeNorMaterialKnows) {
  const BuiltScene built = BuildText(InWorld("Shape \"sphere\" \"float radus\" 2"));
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("scene.pbrt:4:16: warning: unknown parameter \"radus\" of shape "
                                  "\"sphere\"\n    Shape \"sphere\" \"float radus\" 2\n"
                                  "                   ^\n    hint: did you mean \"radius\"?\n"),
            std::string::npos)
      << built.Messages();
}

TEST(SceneBuilder, TakesTheTextureThatIsKnownAtTheShape) {
  const std::string black = "Texture \"t\" \"color\" \"constant\" \"color value\" [0 0 0]\n";
  const std::string white = "Texture \"t\" \"color\" \"constant\" \"color value\" [1 1 1]\n";
  const BuiltScene built =
      BuildText(InWorld(black + "Material \"matte\" \"texture Kd\" \"t\" Shape \"sphere\"\n" +
                        white + "Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  const auto& materials = built.setups[0]->scene->Materials();
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_FALSE(Any(materials[0]->PossibleLobes()));
  EXPECT_TRUE(Any(materials[1]->PossibleLobes()));
  EXPECT_NE(built.Messages().find("texture \"t\" is defined again"), std::string::npos);
}

TEST(SceneBuilder, ForgetsTexturesAtTheEndOfTheirBlock) {
  EXPECT_EQ(
      ShortErrorOf(InWorld("AttributeBegin Texture \"inner\" \"color\" \"constant\" AttributeEnd\n"
                           "Material \"matte\" \"texture Kd\" \"inner\" Shape \"sphere\""))
          .substr(0, 4),
      "5:31");
}

TEST(SceneBuilder, KnowsTheNamedMaterialsOfVersion2) {
  const BuiltScene built = BuildText(InWorld(
      "MakeNamedMaterial \"m\" \"string type\" \"mirror\" NamedMaterial \"m\" Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_TRUE(built.setups[0]->scene->Features().Needs(Feature::Specular));
}

TEST(SceneBuilder, PlacesInstancesByTheMatrixAtTheInstance) {
  const BuiltScene built = BuildText(
      InWorld("ObjectBegin \"o\" Translate 1 0 0 Shape \"sphere\" ObjectEnd\n"
              "Translate 10 0 0 ObjectInstance \"o\" Translate 10 0 0 ObjectInstance \"o\""));
  ASSERT_EQ(built.error, "");
  const Bounds3& bounds = built.setups[0]->scene->WorldBounds();
  EXPECT_NEAR(double(bounds.min.x), 10, 1e-3);
  EXPECT_NEAR(double(bounds.max.x), 22, 1e-3);
  EXPECT_EQ(built.setups[0]->scene->Primitives().Count(), 2u);
}

TEST(SceneBuilder, SaysThatLightsInObjectsAreNotInstanced) {
  const BuiltScene built = BuildText(
      InWorld("ObjectBegin \"o\" LightSource \"point\" AreaLightSource \"area\" Shape \"sphere\" "
              "ObjectEnd ObjectInstance \"o\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups[0]->scene->Lights().size(), 1u);
  EXPECT_NE(built.Messages().find("a light in an object is not repeated with its instances"),
            std::string::npos);
  EXPECT_NE(built.Messages().find("a shape in an object cannot be an area light"),
            std::string::npos);
}

TEST(SceneBuilder, AcceptsVolumeIntegratorsWithoutEffect) {
  const BuiltScene built = BuildText(
      "VolumeIntegrator \"single\" \"float stepsize\" 2\nRenderer \"sampler\"\nTransformTimes 0 1\n"
      "ActiveTransform All\n" +
      kBegin + "WorldEnd");
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("the scene has no Volume: volume integrator \"single\" has "
                                  "nothing to do"),
            std::string::npos);
}

TEST(SceneBuilder, ReportsParametersOfTheRendererWhichHasNone) {
  const BuiltScene built =
      BuildText("Renderer \"sampler\" \"integer threads\" 3\n" + kBegin + "WorldEnd");
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("unknown parameter \"threads\" of renderer \"sampler\""),
            std::string::npos)
      << built.Messages();
}

TEST(SceneBuilder, NamesTheVolumesAndVolumeIntegratorsThatThereAre) {
  const BuiltScene volume = BuildText(kBegin + "Volume \"homogenous\"\nWorldEnd");
  EXPECT_NE(volume.error.find("2:1: error: there is no volume \"homogenous\"; available: "
                              "exponential, homogeneous, volumegrid"),
            std::string::npos)
      << volume.error;
  const BuiltScene integrator = BuildText("VolumeIntegrator \"singel\"\n" + kBegin + "WorldEnd");
  EXPECT_NE(
      integrator.error.find("1:1: error: there is no volume integrator \"singel\"; available: "
                            "emission, single"),
      std::string::npos)
      << integrator.error;
}

TEST(SceneBuilder, WarnsOfASceneWithoutLight) {
  EXPECT_NE(BuildText(InWorld("")).Messages().find("warning: the scene has no light"),
            std::string::npos);
}

TEST(SceneBuilder, WarnsOfABlockWithoutItsEnd) {
  const BuiltScene built = BuildText(InWorld("AttributeBegin"));
  EXPECT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("scene.pbrt:4:1: warning: AttributeBegin without its end"),
            std::string::npos);
}

TEST(SceneBuilder, HashesWhatTheSceneSaysAndNotHowItIsLaidOut) {
  const auto hash = [](const std::string& text) {
    const BuiltScene built = BuildText(text);
    EXPECT_EQ(built.error, "");
    return built.setups.at(0)->sceneHash;
  };
  const std::uint64_t plain = hash(InWorld("Shape \"sphere\" \"float radius\" 2"));
  EXPECT_EQ(plain, hash("# comment\n" + InWorld("Shape   \"sphere\"\n\"float radius\" [2.0]")));
  EXPECT_NE(plain, hash(InWorld("Shape \"sphere\" \"float radius\" 2.5")));
  EXPECT_NE(plain, hash(InWorld("Shape \"disk\" \"float radius\" 2")));
  EXPECT_NE(hash(InWorld("Shape \"disk\"")), hash(InWorld("Shape \"cone\"")));
  // The types say what the numbers mean.
  EXPECT_NE(hash(InWorld("LightSource \"point\" \"rgb I\" [1 2 3]")),
            hash(InWorld("LightSource \"point\" \"xyz I\" [1 2 3]")));
}

TEST(SceneBuilder, RefusesCropWindowsWithoutHeight) {
  EXPECT_EQ(
      ShortErrorOf("Film \"image\" \"float cropwindow\" [0 1 .5 .5]\n" + kBegin + "WorldEnd"),
      "1:14: parameter \"cropwindow\" of film \"image\" is empty or reversed: y0 must be below "
      "y1");
}

TEST(SceneBuilder, RefusesCropWindowsWithoutPixels) {
  EXPECT_EQ(
      ShortErrorOf("Film \"image\" \"float cropwindow\" [.5 .5 0 1]\n" + kBegin + "WorldEnd"),
      "1:14: parameter \"cropwindow\" of film \"image\" is empty or reversed: x0 must be below "
      "x1");
  EXPECT_EQ(
      ShortErrorOf("Film \"image\" \"float cropwindow\" [0 1 0]\n" + kBegin + "WorldEnd"),
      "1:14: parameter \"cropwindow\" of film \"image\" must be four numbers: x0 x1 y0 y1, not "
      "3");
}

}  // namespace
}  // namespace exphoton
