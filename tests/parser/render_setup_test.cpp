// SPDX-License-Identifier: BSD-2-Clause
// These tests check what a RenderSetup holds: the defaults of every directive, that each directive
// and each override of one takes effect, that a second world begins anew, and the warnings of the
// world.
#include <gtest/gtest.h>

#include "core/base/log.h"
#include "core/math/real.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

const RenderSetup& Only(const BuiltScene& built) {
  EXPECT_EQ(built.error, "");
  return *built.setups.at(0);
}

RayDifferential RayOf(const RenderSetup& setup, Point2 film) {
  return setup.camera->GenerateRay({film, {Real(.5), Real(.5)}, 0}, false);
}

// Returns the half-width of the filter: the largest offset.
Point2 ReachOf(const RenderSetup& setup) {
  Point2 reach;
  for (int i = 0; i <= 100; ++i) {
    const Real u = Real(i) / 100 * kOneMinusEpsilon;
    reach.x = std::max(reach.x, setup.filter->Sample({u, Real(.5)}).offset.x);
    reach.y = std::max(reach.y, setup.filter->Sample({Real(.5), u}).offset.y);
  }
  return reach;
}

// The file is not searched for directives of version 2 again.
TEST(RenderSetup, OfAKnownWorldHasItsDialect) {
  const std::string text = "Renderer \"sampler\"\n" + InWorld("Shape \"sphere\"");
  const BuiltScene first = BuildText(text);
  EXPECT_NE(first.Messages().find("scene language version 2"), std::string::npos);
  EXPECT_EQ(Only(first).dialect, Dialect::V2);
  LoadOptions options;
  options.known = first.setups.at(0).get();
  EXPECT_EQ(Only(BuildText("", options)).dialect, Dialect::V2);
}

TEST(RenderSetupDefaults, AreThoseOfVersion1) {
  const BuiltScene built = BuildText("WorldBegin Volume \"homogeneous\" WorldEnd");
  const RenderSetup& setup = Only(built);
  EXPECT_EQ(setup.acceleratorName, "bvh");
  EXPECT_EQ(setup.sceneName, "scene.pbrt");
  EXPECT_EQ(setup.film.filename, "pbrt.exr");
  EXPECT_TRUE(setup.film.premultiplyAlpha);
  EXPECT_EQ(setup.film.xResolution, 640);
  EXPECT_EQ(setup.film.yResolution, 480);
  EXPECT_FALSE(setup.film.cropWindow);
  EXPECT_EQ(setup.camera->Shutter().min, 0);
  EXPECT_EQ(setup.camera->Shutter().max, 1);
  EXPECT_FALSE(setup.camera->HasLens());
  EXPECT_NEAR(double(ReachOf(setup).x), 2, .05);
  EXPECT_NEAR(double(ReachOf(setup).y), 2, .05);
  // 90 degrees along the shorter axis, from hither.
  const RayDifferential top = RayOf(setup, {320, 0});
  EXPECT_NEAR(double(top.d.y), std::sqrt(.5), 1e-5);
  EXPECT_NEAR(double(top.d.x), 0, 1e-5);
  EXPECT_NEAR(double(top.o.z), 1e-3, 1e-8);
  EXPECT_EQ(setup.inputFiles, (std::vector<std::string>{"scene.pbrt"}));
  EXPECT_EQ(setup.plugins,
            (std::vector<std::string>{"accelerators/bvh", "cameras/perspective", "filters/mitchell",
                                      "integrators/directlighting", "samplers/lowdiscrepancy",
                                      "volumeintegrators/emission", "volumes/homogeneous"}));
  ASSERT_TRUE(setup.volumeIntegrator);
}

// A first world with every option, for the second to forget.
const std::string kOptions =
    "Film \"image\" \"string filename\" \"first.exr\" \"integer xresolution\" 12\n"
    "  \"integer yresolution\" 8 \"bool premultiplyalpha\" \"false\"\n"
    "  \"float cropwindow\" [0 .5 .25 1]\n"
    "Sampler \"stratified\" \"integer xsamples\" 3 \"integer ysamples\" 5\n"
    "PixelFilter \"box\" \"float xwidth\" 1.5 \"float ywidth\" 3\n"
    "Accelerator \"kdtree\"\nSurfaceIntegrator \"whitted\"\nVolumeIntegrator \"single\"\n"
    "TransformTimes 2 3\n"
    "Camera \"orthographic\" \"float shutteropen\" 4 \"float shutterclose\" 5\n";

TEST(RenderSetup, HasWhatEachDirectiveAsksFor) {
  const BuiltScene built = BuildText(kOptions + "WorldBegin Volume \"homogeneous\" WorldEnd");
  const RenderSetup& setup = Only(built);
  EXPECT_EQ(setup.film.filename, "first.exr");
  EXPECT_FALSE(setup.film.premultiplyAlpha);
  EXPECT_EQ(setup.film.Full(), (PixelBounds{0, 0, 12, 8}));
  EXPECT_EQ(setup.crop, (PixelBounds{0, 2, 6, 8}));
  EXPECT_EQ(setup.samplerName, "stratified");
  EXPECT_EQ(setup.sampler->SamplesPerPixel(), 15);
  EXPECT_EQ(setup.filterName, "box");
  EXPECT_NEAR(double(ReachOf(setup).x), 1.5, .01);
  EXPECT_NEAR(double(ReachOf(setup).y), 3, .01);
  EXPECT_EQ(setup.acceleratorName, "kdtree");
  EXPECT_EQ(setup.integratorName, "whitted");
  EXPECT_EQ(setup.cameraName, "orthographic");
  EXPECT_EQ(setup.camera->Shutter().min, 4);
  EXPECT_EQ(setup.camera->Shutter().max, 5);
  EXPECT_EQ(setup.plugins,
            (std::vector<std::string>{"accelerators/kdtree", "cameras/orthographic", "filters/box",
                                      "integrators/whitted", "samplers/stratified",
                                      "volumeintegrators/single", "volumes/homogeneous"}));
}

TEST(RenderSetup, OfASecondWorldIsThatOfTheWorldAlone) {
  const std::string state =
      "Translate 1 2 3 CoordinateSystem \"place\" ActiveTransform StartTime Translate 0 1 0\n";
  const std::string first =
      kOptions + state +
      "WorldBegin ReverseOrientation Translate 7 7 7 Material \"mirror\" AreaLightSource \"area\"\n"
      "Texture \"t\" \"float\" \"constant\" MakeNamedMaterial \"m\" \"string type\" \"glass\"\n"
      "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd Shape \"disk\" WorldEnd\n";
  const std::string second = "WorldBegin Shape \"sphere\" WorldEnd\n";
  LoadOptions options;  // MakeNamedMaterial would make the whole file one of version 2
  options.dialect = Dialect::V1;
  const BuiltScene both = BuildText(first + second, options), alone = BuildText(second, options);
  ASSERT_EQ(both.setups.size(), 2u) << both.error;
  const RenderSetup &a = *both.setups[1], &b = Only(alone);
  EXPECT_EQ(a.sceneHash, b.sceneHash);
  EXPECT_EQ(a.plugins, b.plugins);
  EXPECT_EQ(a.inputFiles, b.inputFiles);
  EXPECT_EQ(a.film.filename, b.film.filename);
  EXPECT_EQ(a.film.premultiplyAlpha, b.film.premultiplyAlpha);
  EXPECT_EQ(a.crop, b.crop);
  EXPECT_EQ(a.samplerName + a.filterName + a.cameraName + a.integratorName + a.acceleratorName,
            b.samplerName + b.filterName + b.cameraName + b.integratorName + b.acceleratorName);
  EXPECT_EQ(a.camera->Shutter().max, b.camera->Shutter().max);
  EXPECT_TRUE(a.camera->CameraToWorld().IsIdentity());
  EXPECT_FALSE(a.camera->MovesWithin({-kInfinity, kInfinity}));
  EXPECT_EQ(a.scene->Lights().size(), 0u);
  EXPECT_EQ(a.scene->WorldBounds().max, b.scene->WorldBounds().max);
  EXPECT_EQ(a.scene->Primitives().PossibleLobes(), b.scene->Primitives().PossibleLobes());
  Ray ray;
  ray.o = {0, 0, -5}, ray.d = {0, 0, 1};
  const auto surface = a.scene->Intersect(ray);
  ASSERT_TRUE(surface);
  EXPECT_LT(surface->ng.z, 0);
  // Names of the first world are unknown in the second.
  for (const char* use :
       {"CoordSysTransform \"place\"", "ObjectInstance \"o\"", "NamedMaterial \"m\"",
        "Material \"matte\" \"texture sigma\" \"t\" Shape \"disk\""})
    EXPECT_EQ(BuildText(first + "WorldBegin " + use + " WorldEnd").status, 2) << use;
}

// Each directive, with a parameter that the override changes and how to see it.
TEST(Overrides, ReachEveryDirectiveThatCanBeSet) {
  const auto with = [](const ParameterOverride& override) {
    LoadOptions options;
    options.parameters = {override};
    return BuildText(kOptions + "WorldBegin Volume \"homogeneous\" Shape \"sphere\" WorldEnd",
                     options);
  };
  EXPECT_EQ(Only(with({"Film", "filename", "other.exr"})).film.filename, "other.exr");
  EXPECT_TRUE(Only(with({"Film", "premultiplyalpha", "true"})).film.premultiplyAlpha);
  EXPECT_EQ(Only(with({"Film", "cropwindow", "0,1,0,.5"})).crop, (PixelBounds{0, 0, 12, 4}));
  EXPECT_EQ(Only(with({"Film", "cropwindow", "[ 0 1 +0 .5 ]"})).crop, (PixelBounds{0, 0, 12, 4}));
  EXPECT_EQ(Only(with({"Sampler", "ysamples", "7"})).sampler->SamplesPerPixel(), 21);
  EXPECT_NEAR(double(ReachOf(Only(with({"PixelFilter", "ywidth", "2"}))).y), 2, .01);
  EXPECT_EQ(Only(with({"Camera", "shutterclose", "9"})).camera->Shutter().max, 9);
  const auto errorOf = [&](const ParameterOverride& override) {
    const BuiltScene built = with(override);
    EXPECT_EQ(built.status, 1);
    return built.error.substr(0, built.error.find('\n'));
  };
  // For the others, that their values are checked.
  EXPECT_EQ(errorOf({"Accelerator", "maxprims", "x"}),
            "<command line>:1:28: error: parameter \"maxprims\" takes numbers, not \"x\"");
  EXPECT_NE(errorOf({"Accelerator", "maxprims", "0"}).find("\"maxprims\""), std::string::npos);
  EXPECT_NE(errorOf({"SurfaceIntegrator", "maxdepth", "-5"}).find("\"maxdepth\""),
            std::string::npos);
  EXPECT_NE(errorOf({"VolumeIntegrator", "stepsize", "-1"}).find("\"stepsize\""),
            std::string::npos);
  EXPECT_NE(errorOf({"Sampler", "jitter", "perhaps"}).find("\"jitter\""), std::string::npos);
  EXPECT_EQ(errorOf({"PixelFilter", "width", "2"}),
            "<command line>:1:25: error: --set: unknown parameter \"width\" of filter \"box\"");
  EXPECT_EQ(errorOf({"Film", "xresolution", "1,2x"}),
            "<command line>:1:24: error: parameter \"xresolution\" takes numbers, not \"1,2x\"");
  EXPECT_EQ(errorOf({"Film", "xresolution", "inf"}),
            "<command line>:1:24: error: parameter \"xresolution\" takes numbers, not \"inf\"");
}

TEST(RenderSetup, SaysHowManySamplesASamplerTakesInstead) {
  LoadOptions options;
  options.samplesPerPixel = 5;
  const BuiltScene built = BuildText(InWorld(""), options);
  EXPECT_EQ(Only(built).sampler->SamplesPerPixel(), 8);
  EXPECT_NE(
      built.Messages().find("sampler \"lowdiscrepancy\" takes 8 samples a pixel instead of 5\n"),
      std::string::npos);
  options.samplesPerPixel = 4;
  EXPECT_EQ(BuildText(InWorld(""), options).Messages().find("instead of"), std::string::npos);
}

TEST(RenderSetup, CropsByPixelsAtTheHeightOfTallAndWidePictures) {
  LoadOptions options;
  options.pixelBounds = PixelBounds{0, 0, 50, 50};
  for (const auto& [width, height] : {std::pair(4, 9), std::pair(9, 4)}) {
    const std::string film = "Film \"image\" \"integer xresolution\" " + std::to_string(width) +
                             " \"integer yresolution\" " + std::to_string(height) + "\n";
    EXPECT_EQ(Only(BuildText(film + "WorldBegin WorldEnd", options)).crop,
              (PixelBounds{0, 0, width, height}));
  }
}

TEST(RenderSetup, CropsByPixelsOnEverySide) {
  LoadOptions options;
  options.pixelBounds = PixelBounds{-5, -6, 3, 2};
  EXPECT_EQ(Only(BuildText(InWorld(""), options)).crop, (PixelBounds{0, 0, 3, 2}));
  options.pixelBounds = PixelBounds{1, 2, 30, 40};
  EXPECT_EQ(Only(BuildText(InWorld(""), options)).crop, (PixelBounds{1, 2, 4, 4}));
  options.pixelBounds.reset();
  options.cropWindow = std::vector<Real>{0, Real(.5), Real(.25), 1};
  EXPECT_EQ(Only(BuildText(InWorld(""), options)).crop, (PixelBounds{0, 1, 2, 4}));
  options.cropWindow = std::vector<Real>{Real(.01), Real(.02), 0, 1};
  const BuiltScene empty = BuildText(InWorld(""), options);
  EXPECT_EQ(empty.status, 1);
  EXPECT_EQ(empty.error, "exphoton: error: the crop window has no pixel's upper left corner\n");
  const BuiltScene file = BuildText(
      "Film \"image\" \"integer xresolution\" 4 \"float cropwindow\" [.01 .02 0 1]\n"
      "WorldBegin WorldEnd");
  EXPECT_EQ(file.status, 2);
  EXPECT_EQ(file.error.substr(0, file.error.find('\n')),
            "scene.pbrt:1:38: error: the crop window has no pixel's upper left corner");
}

// Products of float fractions and the width would move 5 to 6 and 27 to 28.
TEST(RenderSetup, ScalesPixelBoundsOfAnotherResolution) {
  const std::string text =
      "Film \"image\" \"integer xresolution\" 300 \"integer yresolution\" 200\nWorldBegin WorldEnd";
  LoadOptions options;
  options.boundsResolution = Point2i{300, 200};
  for (const int x : {0, 5, 10, 20, 27, 299}) {
    options.pixelBounds = PixelBounds{x, 199, x + 1, 200};
    options.isQuick = false;
    EXPECT_EQ(Only(BuildText(text, options)).crop, *options.pixelBounds);
    options.isQuick = true;  // a quarter of the resolution
    EXPECT_EQ(Only(BuildText(text, options)).crop, (PixelBounds{x / 4, 49, x / 4 + 1, 50}));
  }
  options.pixelBounds = PixelBounds{3, 0, 9, 200};
  EXPECT_EQ(Only(BuildText(text, options)).crop, (PixelBounds{0, 0, 3, 50}));
}

TEST(RenderSetup, RefusesOtherFilmsAndRenderers) {
  const auto errorOf = [](const std::string& text) {
    const BuiltScene built = BuildText(text + "\nWorldBegin WorldEnd");
    EXPECT_EQ(built.status, 2);
    return built.error.substr(0, built.error.find('\n'));
  };
  EXPECT_EQ(errorOf("Film \"imag\""),
            "scene.pbrt:1:1: error: unknown film \"imag\"; known: \"image\"");
  EXPECT_EQ(errorOf("Renderer \"samplers\""),
            "scene.pbrt:1:1: error: unknown renderer \"samplers\"; known: \"sampler\", "
            "\"metropolis\", \"createprobes\", \"surfacepoints\", \"aggregatetest\"");
}

// Each message of the world in its words, with the place of its directive.
TEST(WorldMessages, AreSaidInTheseWords) {
  const auto saysAt = [](int line, const std::string& world, const std::string& message) {
    const BuiltScene built =
        BuildText("Accelerator \"bruteforce\"\nWorldBegin\n" + world + "\nWorldEnd");
    const std::string said = "scene.pbrt:" + std::to_string(line) + ":1: " + message + "\n";
    EXPECT_NE((built.Messages() + built.error).find(said), std::string::npos)
        << said << built.Messages() << built.error;
  };
  const std::string moving = "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All\n";
  saysAt(4, "ObjectBegin \"o\"\nLightSource \"point\"\nObjectEnd",
         "warning: a light in an object is not repeated with its instances: it shines once, "
         "where the object is defined");
  saysAt(4, "ObjectBegin \"o\"\nVolume \"homogeneous\"\nObjectEnd",
         "warning: a volume in an object is not repeated with its instances");
  saysAt(4, "ObjectBegin \"o\" AreaLightSource \"area\"\nShape \"sphere\"\nObjectEnd",
         "warning: a shape in an object cannot be an area light: it does not emit");
  saysAt(4, moving + "Texture \"t\" \"float\" \"constant\"",
         "warning: a texture does not move: it uses the transformation at StartTime");
  saysAt(4, moving + "LightSource \"point\"",
         "error: a light source cannot move; shapes, area lights on them, instances and the "
         "camera can");
  saysAt(4, moving + "Volume \"homogeneous\"",
         "error: a volume cannot move; shapes, area lights on them, instances and the camera can");
  if (sizeof(Real) == 4) {  // double holds this area
    saysAt(4, "AreaLightSource \"area\" Scale 1e-30 1e-30 1e-30\nShape \"sphere\"",
           "warning: an area light of area 0 does not emit");
    saysAt(4, "AreaLightSource \"area\" Scale 1e30 1e30 1e30\nShape \"sphere\"",
           "warning: an area light whose area is not a finite number does not emit");
  }
  saysAt(3, "Texture \"t\" \"vector\" \"constant\"",
         "error: texture \"t\" has type \"vector\"; types of textures are \"float\" and \"color\"");
  saysAt(4, "Texture \"t\" \"float\" \"constant\"\nTexture \"t\" \"float\" \"constant\"",
         "warning: texture \"t\" is defined again: later shapes use the new one");
}

TEST(WorldMessages, SayThatASceneIsDarkUnlessAMediumGlows) {
  const auto warns = [](const std::string& world) {
    const BuiltScene built = BuildText(InWorld(world + " Shape \"sphere\""));
    EXPECT_EQ(built.error, "");
    return built.Messages().find("the scene has no light") != std::string::npos;
  };
  EXPECT_TRUE(warns(""));
  EXPECT_TRUE(warns("Volume \"homogeneous\" \"color sigma_a\" [1 1 1]"));
  EXPECT_FALSE(warns("Volume \"homogeneous\" \"color Le\" [1 1 1]"));
  EXPECT_FALSE(warns("LightSource \"point\""));
}

TEST(WorldMessages, SayThatAllLightsAreBlack) {
  const auto warns = [](const std::string& world) {
    const BuiltScene built = BuildText(InWorld(world + " Shape \"sphere\""));
    EXPECT_EQ(built.error, "");
    return built.Messages().find("all lights of the scene are black") != std::string::npos;
  };
  const std::string black = "LightSource \"point\" \"color I\" [0 0 0]\n";
  EXPECT_TRUE(warns(black));
  EXPECT_TRUE(warns(black + "AreaLightSource \"area\" \"color L\" [0 0 0]"));
  EXPECT_FALSE(warns(black + "LightSource \"point\""));
  EXPECT_FALSE(warns(black + "Volume \"homogeneous\" \"color Le\" [1 1 1]"));
  EXPECT_FALSE(warns(""));
}

TEST(WorldMessages, SayWhyAMeshIsInvisible) {
  const auto messages = [](const std::string& indices) {
    return BuildText(InWorld("LightSource \"point\" Shape \"trianglemesh\" \"point P\" "
                             "[0 0 0 1 0 0 1 1 0] \"float alpha\" 0 \"integer indices\" " +
                             indices))
        .Messages();
  };
  EXPECT_NE(messages("[0 1 2]").find("the mesh is invisible, because its alpha is 0"),
            std::string::npos);
  EXPECT_EQ(messages("[0 1 2]").find("no triangles"), std::string::npos);
}

TEST(RenderSetup, InputFilesOfAWorldAreNotThoseOfTheWorldBefore) {
  const std::string image = std::string(EXPHOTON_SOURCE_DIR) + "/scenes/parts/painting.png";
  const BuiltScene built = BuildText("WorldBegin LightSource \"infinite\" \"string mapname\" \"" +
                                     image + "\" WorldEnd\nWorldBegin Shape \"sphere\" WorldEnd");
  ASSERT_EQ(built.setups.size(), 2u) << built.error;
  EXPECT_EQ(built.setups[0]->inputFiles, (std::vector<std::string>{image, "scene.pbrt"}));
  EXPECT_EQ(built.setups[1]->inputFiles, std::vector<std::string>{"scene.pbrt"});
}

TEST(Textures, OfBothKindsMayShareAName) {
  const BuiltScene built = BuildText(
      InWorld("Texture \"t\" \"float\" \"constant\" Texture \"t\" \"color\" \"constant\"\n"
              "Texture \"t2\" \"spectrum\" \"constant\"\n"
              "Material \"matte\" \"texture Kd\" \"t\" \"texture sigma\" \"t\" Shape \"sphere\"\n"
              "Material \"matte\" \"texture Kd\" \"t2\" Shape \"sphere\""));
  EXPECT_EQ(built.error, "");
  EXPECT_EQ(built.Messages().find("defined again"), std::string::npos) << built.Messages();
}

TEST(Materials, TakeTheParametersThatTheShapeDoesNotDeclare) {
  const BuiltScene built = BuildText(
      InWorld("Material \"matte\"\nShape \"sphere\" \"float radius\" 2 \"color Kd\" [0 0 0]\n"
              "Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  const auto& primitives = Only(built).scene->Primitives();
  EXPECT_FALSE(Any(primitives.PossibleLobes(0)));
  EXPECT_TRUE(Any(primitives.PossibleLobes(1)));
  EXPECT_NEAR(double(primitives.Bounds(0).max.x), 2, 1e-5);
  EXPECT_NEAR(double(primitives.Bounds(1).max.x), 1, 1e-5);
  EXPECT_EQ(Only(built).scene->Materials().size(), 2u);
}

TEST(EffectChoice, IsInThePlanOfTheScene) {
  LoadOptions options;
  options.effects = "indirect=off";
  const BuiltScene built = BuildText(InWorld("LightSource \"point\" Shape \"sphere\""), options);
  EXPECT_FALSE(Only(built).scene->Features().Needs(Feature::Indirect));
  EXPECT_EQ(Only(built).scene->Features().Get(Feature::Indirect).reason, "by --effects");
  EXPECT_NE(built.Messages().find("--effects indirect=off leaves out light that the scene needs"),
            std::string::npos);
}

}  // namespace
}  // namespace exphoton
