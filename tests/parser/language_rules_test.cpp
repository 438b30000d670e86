// SPDX-License-Identifier: BSD-2-Clause
// These tests check the rules that let files of other programs render: several errors in one run,
// substitutes for plugins that are not available, parameters of another type, files in several
// folders, and the defaults of version 2.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/parser/builder/texture_table.h"
#include "core/plugins/registry.h"
#include "core/plugins/search.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

BuiltScene BuildStrictly(const std::string& text) {
  LoadOptions options;
  options.isStrict = true;
  return BuildText(text, options);
}

TEST(SeveralErrors, AreReportedInOneRun) {
  const BuiltScene built = BuildText(
      "Sampler \"nosampler\"\nCamera \"nocamera\"\n" +
      InWorld("Texture \"t\" \"color\" \"nothing\"\nMaterial \"matte\" \"texture Kd\" \"t\"\n"
              "Shape \"sphere\" \"float radius\" -1\nMaterial \"matte\" \"texture Kd\" \"u\"\n"
              "Shape \"sphere\"\nShape \"disk\"\nAttributeEnd"));
  // The texture that could not be made is defined for what follows. The second texture is reported
  // once, although two shapes use it.
  EXPECT_EQ(CountOf(built.error, "error:"), 6) << built.error;
  for (const char* part : {"nosampler", "nocamera", "texture \"nothing\"", "radius",
                           "not defined: \"u\"", "AttributeEnd without"})
    EXPECT_EQ(CountOf(built.error, part) > 0, true) << part << "\n" << built.error;
  EXPECT_EQ(built.status, 2);
  EXPECT_TRUE(built.setups.empty());
}

TEST(SeveralErrors, AreTwentyAtMost) {
  std::string text;
  for (int i = 0; i < 40; ++i) text += "Shape \"none" + std::to_string(i) + "\"\n";
  const BuiltScene built = BuildText(InWorld(text));
  EXPECT_EQ(CountOf(built.error, "there is no shape"), 20);
  EXPECT_EQ(CountOf(built.error, "too many errors"), 1);
}

TEST(SeveralErrors, OfAWorldLeaveTheNextWorldToBeChecked) {
  const BuiltScene built =
      BuildText(InWorld("ObjectBegin \"o\"") + InWorld("Shape \"none\"") + InWorld(""));
  EXPECT_EQ(CountOf(built.error, "has no ObjectEnd"), 1);
  EXPECT_EQ(CountOf(built.error, "there is no shape"), 1);
  EXPECT_EQ(CountOf(built.error, "error:"), 2) << built.error;
}

TEST(Substitutes, AreUsedWithAWarningThatSaysWhatIsLost) {
  const BuiltScene built = BuildText("Sampler \"sobol\"\n" + InWorld("Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("there is no sampler \"sobol\": \"lowdiscrepancy\" is used "
                                  "instead; its points differ, the picture does not"),
            std::string::npos)
      << built.Messages();
  const BuiltScene strict = BuildStrictly("Sampler \"sobol\"\n" + InWorld("Shape \"sphere\""));
  EXPECT_NE(strict.error.find("there is no sampler \"sobol\"; available:"), std::string::npos);
}

TEST(Substitutes, StandInForPluginsOfVersions3And4) {
  const BuiltScene built =
      BuildText("SurfaceIntegrator \"lightpath\"\nCamera \"realistic\"\nSampler \"independent\"\n" +
                InWorld("Shape \"sphere\""));
  ASSERT_EQ(built.error, "");
  for (const char* part :
       {"there is no integrator \"lightpath\": \"bidirectional\" is used instead",
        "there is no camera \"realistic\": \"perspective\" is used instead; there is no lens, and "
        "\"fov\" sets the field of view"})
    EXPECT_EQ(CountOf(built.Messages(), part), 1) << part << "\n" << built.Messages();
  // "independent" and "random" are two names of one sampler. The third warning: there is no light.
  EXPECT_EQ(built.log->WarningCount(), 3) << built.Messages();
  const std::pair<const char*, const char*> directives[] = {{"Camera", "spherical"},
                                                            {"Sampler", "paddedsobol"},
                                                            {"Sampler", "zsobol"},
                                                            {"Sampler", "pmj02bn"},
                                                            {"SurfaceIntegrator", "simplepath"},
                                                            {"SurfaceIntegrator", "simplevolpath"},
                                                            {"SurfaceIntegrator", "randomwalk"}};
  for (const auto& [directive, name] : directives) {
    const std::string text =
        directive + (" \"" + std::string(name)) + "\"\n" + InWorld("Shape \"sphere\"");
    EXPECT_EQ(BuildText(text).error, "") << name;
    EXPECT_NE(BuildStrictly(text).error.find(name), std::string::npos) << name;
  }
}

TEST(Substitutes, AreAvailableThemselves) {
  const std::string folder = std::string(EXPHOTON_BINARY_DIR) + "/plugins";
  Log log(Log::Level::Normal, Log::Sink::Memory);
  PluginRegistry registry(std::vector<std::string>{folder}, &log);
  for (const PluginAlias& alias : AllPluginAliases()) {
    const auto available = registry.Available(alias.kind);
    EXPECT_EQ(std::count(available.begin(), available.end(), alias.name), 1) << alias.alias;
    EXPECT_EQ(std::count(available.begin(), available.end(), alias.alias), 0) << alias.alias;
  }
}

TEST(Substitutes, ForUnknownMaterialsAreMatte) {
  const std::string text = InWorld("Material \"platsic\"\nShape \"sphere\"");
  const BuiltScene built = BuildText(text);
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("there is no material \"platsic\": \"matte\" is used instead"),
            std::string::npos);
  EXPECT_NE(built.Messages().find("did you mean \"plastic\"?"), std::string::npos);
  EXPECT_NE(BuildStrictly(text).error.find("there is no material \"platsic\""), std::string::npos);
  for (const char* other : {"Shape \"sphare\"", "LightSource \"pont\""})
    EXPECT_NE(BuildText(InWorld(other)).error.find("did you mean"), std::string::npos) << other;
}

TEST(Substitutes, ForRenderersOfVersion2AreIntegrators) {
  const std::string rest = InWorld("Shape \"sphere\"");
  const BuiltScene metropolis =
      BuildText("Renderer \"metropolis\" \"integer maxdepth\" 3\n" + rest);
  ASSERT_EQ(metropolis.error, "");
  EXPECT_EQ(metropolis.setups.at(0)->integratorName, "path");
  EXPECT_NE(metropolis.Messages().find("there is no renderer \"metropolis\": integrator \"path\""),
            std::string::npos);
  const BuiltScene probes =
      BuildText("SurfaceIntegrator \"whitted\" Renderer \"createprobes\"\n" + rest);
  ASSERT_EQ(probes.error, "");
  EXPECT_EQ(probes.setups.at(0)->integratorName, "whitted");
  LoadOptions chosen;
  chosen.integrator = "exphotonmap";
  const BuiltScene overridden = BuildText("Renderer \"metropolis\"\n" + rest, chosen);
  EXPECT_EQ(overridden.setups.at(0)->integratorName, "exphotonmap");
  EXPECT_NE(BuildStrictly("Renderer \"metropolis\"\n" + rest).error.find("there is no renderer"),
            std::string::npos);
}

TEST(ParameterTypes, ThatAreWrongLeaveTheDefault) {
  const std::string text =
      "Film \"image\" \"integer premultiplyalpha\" [0] \"float xresolution\" 6 "
      "\"integer yresolution\" 4\nPixelFilter \"box\" \"string xwidth\" \"2\"\n"
      "Accelerator \"bruteforce\" WorldBegin Shape \"sphere\" WorldEnd";
  const BuiltScene built = BuildText(text);
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups.at(0)->film.xResolution, 6);  // an integral float is an integer
  EXPECT_EQ(built.setups.at(0)->filter->XWidth(), Real(.5));
  EXPECT_NE(built.Messages().find("parameter \"xwidth\" of filter \"box\" keeps its default: it "
                                  "must be of type \"float\", not \"string\""),
            std::string::npos)
      << built.Messages();
  const BuiltScene strict = BuildStrictly(text);
  EXPECT_NE(strict.error.find("\"xwidth\""), std::string::npos);
  // A required parameter has no default, and a wrong count stays an error.
  EXPECT_NE(BuildText(InWorld("Shape \"trianglemesh\" \"float indices\" [0 1 2] \"float P\" [0]"))
                .error.find("must be of type \"point\""),
            std::string::npos);
  EXPECT_NE(BuildText(InWorld("Shape \"sphere\" \"float radius\" [1 2]")).error, "");
}

TEST(SubdivisionSchemes, OtherThanLoopAreIgnored) {
  const BuiltScene built =
      BuildText(InWorld("Shape \"loopsubdiv\" \"integer nlevels\" 0 \"integer indices\" [0 1 2] "
                        "\"point P\" [0 0 0 1 0 0 0 1 0] \"string scheme\" \"catmull-clark\""));
  EXPECT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("\"catmull-clark\" is not available"), std::string::npos);
}

TEST(MissingFiles, AreReportedWithThePlacesThatWereTried) {
  const BuiltScene built = BuildText(
      InWorld("Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"no/such.png\""));
  EXPECT_NE(built.error.find("hint: tried \"no/such.png\""), std::string::npos) << built.error;
}

// The red part of matte's default Kd shows the dialect: 1 in version 1, .5 in version 2.
Real DiffuseOf(const BuiltScene& built) {
  const Scene& scene = *built.setups.at(0)->scene;
  RayDifferential ray;
  ray.o = {0, 0, -5};
  ray.d = {0, 0, 1};
  auto hit = scene.Intersect(ray);
  if (!hit) return -1;
  Arena arena;
  return hit->material->Evaluate(&*hit, TransportMode::Radiance, &arena).Rho(LobeSet::All).r;
}

// The reflectances of media follow from the dipole model; see subsurface_reflectance_test.cpp.
TEST(Substitutes, ForSubsurfaceReflectWhatTheMediumReflects) {
  const struct {
    const char* parameters;
    double red;
  } cases[] = {
      {"", .9077},
      {"\"string name\" \"Skin1\"", .4360},
      {"\"string name\" \"Skin1\" \"color sigma_prime_s\" [.096 .5 .5]", .1655},
      {"\"color sigma_a\" [1 1 1] \"color sigma_prime_s\" [3 3 3] \"float index\" 1", .2073},
      {"\"color sigma_a\" [1 1 1] \"color sigma_s\" [6 6 6] \"float g\" .5 \"float eta\" 1 "
       "\"float scale\" 9",
       .2073},
      {"\"color reflectance\" [.3 .3 .3] \"color sigma_a\" [1 1 1]", .3},
  };
  for (const auto& [parameters, red] : cases) {
    const BuiltScene built = BuildText(
        InWorld("Material \"subsurface\" " + std::string(parameters) + "\nShape \"sphere\""));
    ASSERT_EQ(built.error, "") << parameters;
    EXPECT_NEAR(DiffuseOf(built), red, 1e-4) << parameters;
    EXPECT_EQ(built.log->WarningCount(), 2) << built.Messages();  // one: there is no light
  }
  const BuiltScene given = BuildText(
      InWorld("Material \"subsurface\" \"color Kd\" [.3 .3 .3] \"string name\" \"Skin1\"\n"
              "Shape \"sphere\""));
  EXPECT_NEAR(DiffuseOf(given), .3, 1e-6);
  EXPECT_EQ(
      CountOf(given.Messages(), "parameter \"name\" of material \"subsurface\" has no effect"), 1)
      << given.Messages();
  const BuiltScene unknown =
      BuildText(InWorld("Material \"subsurface\" \"string name\" \"Skin3\" \"color Kr\" [1 1 1]\n"
                        "Shape \"sphere\""));
  EXPECT_NEAR(DiffuseOf(unknown), .9077, 1e-4);
  for (const char* part :
       {"the medium \"Skin3\" of material \"subsurface\" is not known: \"Wholemilk\" is used",
        "did you mean \"Skin1\"?", "parameter \"Kr\" does not apply to material \"subsurface\""})
    EXPECT_EQ(CountOf(unknown.Messages(), part), 1) << part << "\n" << unknown.Messages();
  EXPECT_NE(BuildText(InWorld("Material \"subsurface\" \"color sigma_a\" [-1 1 1] "
                              "Shape \"sphere\""))
                .error.find("parameter \"sigma_a\" of material \"subsurface\" must be at least 0"),
            std::string::npos);
  EXPECT_NEAR(DiffuseOf(BuildText(InWorld("Material \"kdsubsurface\" \"color Kd\" [.3 .3 .3] "
                                          "Shape \"sphere\""))),
              .3, 1e-6);
}

TEST(Version2, IsRecognisedByItsDirectives) {
  const std::string sphere = "Shape \"sphere\"";
  const BuiltScene plain = BuildText(InWorld(sphere));
  ASSERT_EQ(plain.error, "");
  EXPECT_EQ(plain.setups[0]->filterName, "mitchell");
  EXPECT_EQ(CountOf(plain.Messages(), "version 2"), 0);
  for (const std::string& text :
       {"Renderer \"sampler\"\n" + InWorld(sphere),
        InWorld("MakeNamedMaterial \"m\" \"string type\" \"mirror\"\n" + sphere),
        InWorld("AttributeBegin AreaLightSource \"diffuse\" AttributeEnd\n" + sphere),
        InWorld("Texture \"t\" \"spectrum\" \"constant\"\n" + sphere)}) {
    const BuiltScene built = BuildText(text);
    ASSERT_EQ(built.error, "") << text;
    EXPECT_EQ(built.setups[0]->filterName, "box") << text;
    EXPECT_EQ(CountOf(built.Messages(), "scene language version 2, recognised by"), 1) << text;
    LoadOptions version1;
    version1.dialect = Dialect::V1;
    EXPECT_EQ(BuildText(text, version1).setups.at(0)->filterName, "mitchell");
  }
  LoadOptions version2;
  version2.dialect = Dialect::V2;
  EXPECT_EQ(BuildText(InWorld(sphere), version2).setups.at(0)->filterName, "box");
  // Neither a comment nor these directives decide.
  EXPECT_EQ(BuildText("# Renderer\nTransformTimes 0 1 ActiveTransform All\n" + InWorld(sphere))
                .setups.at(0)
                ->filterName,
            "mitchell");
}

TEST(Version2, HasItsOwnDefaultsOfMaterials) {
  LoadOptions version2;
  version2.dialect = Dialect::V2;
  const struct {
    const char* material;
    Real v1, v2;
  } cases[] = {{"matte", 1, Real(.5)}, {"mirror", 1, Real(.9)}};
  for (const auto& [material, v1, v2] : cases) {
    const std::string text = InWorld("Material \"" + std::string(material) + "\" Shape \"sphere\"");
    EXPECT_NEAR(DiffuseOf(BuildText(text)), v1, 1e-6) << material;
    EXPECT_NEAR(DiffuseOf(BuildText(text, version2)), v2, 1e-6) << material;
  }
  EXPECT_NEAR(DiffuseOf(BuildText(InWorld("Shape \"sphere\""), version2)), .5, 1e-6);
  for (const char* material : {"plastic", "translucent", "uber"}) {
    const std::string given = InWorld("Material \"" + std::string(material) +
                                      "\" \"color Kd\" [.25 .25 .25] \"color Ks\" [.25 .25 .25] "
                                      "Shape \"sphere\"");
    const std::string absent =
        InWorld("Material \"" + std::string(material) + "\" Shape \"sphere\"");
    EXPECT_EQ(DiffuseOf(BuildText(absent, version2)), DiffuseOf(BuildText(given))) << material;
    EXPECT_NE(DiffuseOf(BuildText(absent)), DiffuseOf(BuildText(given))) << material;
  }
}

// A name that textures of both kinds have is one name.
TEST(Textures, OfBothKindsAreNamedOnce) {
  TextureTable table;
  const TextureGraph graph;
  table.Define("a", Uniform(Real(1)), graph);
  table.Define("b", Uniform(Real(1)), graph);
  table.Define("b", Uniform(Spectrum(1)), graph);
  table.Define("c", Uniform(Spectrum(1)), graph);
  EXPECT_EQ(table.Names(), (std::vector<std::string>{"a", "b", "c"}));
}

// A texture of the same name in another block is another texture.
TEST(Textures, OfABlockEndWithIt) {
  const auto block = [](const std::string& texture) {
    return "AttributeBegin " + texture + " Shape \"sphere\" AttributeEnd\n";
  };
  const auto define = [](const std::string& value) {
    return "Texture \"t\" \"color\" \"constant\" \"color value\" [" + value + "]";
  };
  const std::string material = "Material \"matte\" \"texture Kd\" \"t\"\n";
  const BuiltScene two = BuildText(InWorld(
      material + block(define(".2 .2 .2") + " Translate 5 0 0") + block(define(".7 .7 .7"))));
  ASSERT_EQ(two.error, "");
  EXPECT_NEAR(DiffuseOf(two), .7, 1e-6);
  const BuiltScene gone = BuildText(InWorld(material + block(define(".2 .2 .2")) + block("")));
  EXPECT_NE(gone.error.find("not defined: \"t\""), std::string::npos);
}

// Of each triangle, another corner has the normal 0.
TEST(Shapes, CountTrianglesWithAUselessNormalAtAnyCorner) {
  const BuiltScene built =
      BuildText(InWorld("Shape \"trianglemesh\" \"integer indices\" [0 1 2 2 0 1 1 2 0 1 3 4] "
                        "\"point P\" [0 0 0 1 0 0 "
                        "0 1 0 0 0 1 1 1 1] \"normal N\" [0 0 0 0 0 1 0 0 1 0 0 1 0 0 1]"));
  ASSERT_EQ(built.error, "");
  EXPECT_NE(built.Messages().find("the mesh has 3 triangles whose vertex normals are 0"),
            std::string::npos)
      << built.Messages();
}

// A parameter that shape and material both have is the shape's.
TEST(Shapes, OverrideOnlyWhatTheyDoNotHaveThemselves) {
  const std::string mesh = testing::TempDir() + "exphoton_triangle.obj";
  std::ofstream(mesh) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const BuiltScene built =
      BuildText(InWorld("Material \"measured\" \"string filename\" \"" EXPHOTON_SOURCE_DIR
                        "/tests/random/glossy.brdf\"\nShape \"obj\" \"string filename\" \"" +
                        mesh + "\""));
  ASSERT_EQ(built.error, "");
  EXPECT_EQ(built.setups.at(0)->scene->WorldBounds().max.y, 1);
  const BuiltScene painted = BuildText(
      InWorld("Material \"matte\" Shape \"sphere\" \"color Kd\" [.7 .7 .7] \"float radius\" 2"));
  ASSERT_EQ(painted.error, "");
  EXPECT_NEAR(DiffuseOf(painted), .7, 1e-6);
}

}  // namespace
}  // namespace exphoton
