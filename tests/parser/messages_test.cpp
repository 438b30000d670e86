// SPDX-License-Identifier: BSD-2-Clause
// These tests check the wording of errors, warnings and hints of the scene language that no other
// test reads in full.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/parser/effect_choice.h"
#include "tests/parser/parse_support.h"

namespace exphoton {
namespace {

// Returns everything that a user reads: the warnings and notices, and then the errors.
std::string TextOf(const std::string& scene, LoadOptions options = {}) {
  const BuiltScene built = BuildText(scene, options);
  return built.Messages() + built.error;
}

struct Case {
  std::string scene;
  std::vector<const char*> parts;
};
void ExpectTexts(const std::vector<Case>& cases, const LoadOptions& options = {}) {
  for (const Case& each : cases) {
    const std::string text = TextOf(each.scene, options);
    for (const char* part : each.parts)
      EXPECT_NE(text.find(part), std::string::npos) << "expected: " << part << "\nread: " << text;
  }
}

TEST(Messages, OfValues) {
  ExpectTexts({
      {InWorld("Shape \"sphere\" \"float radius\" [\"1\"]"),
       {"scene.pbrt:4:32: error: parameter \"radius\" of type float takes numbers, found the "
        "string \"1\"\n"}},
      {InWorld("Shape \"sphere\" \"float radius\" [1 2]"),
       {"parameter \"radius\" of shape \"sphere\" needs exactly one value, not 2"}},
      {InWorld("LightSource \"point\" \"point from\" [1e39 0 0]"),
       {"scene.pbrt:4:35: error: the number 1e39 is out of range\n"}},
      {InWorld("Shape \"sphere\" \"float radius\" -1"),
       {"parameter \"radius\" of shape \"sphere\" must be ", ", not -1"}},
      {InWorld("Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1]"),
       {"parameter \"P\" of shape \"trianglemesh\" needs a multiple of 3 numbers, not 4"}},
      {InWorld("Material \"matte\" \"texture Kd\" \"t\" Shape \"sphere\""),
       {"parameter \"Kd\" of material \"matte\" names a texture that is not defined: \"t\""}},
      {InWorld("Texture \"bricks\" \"color\" \"constant\" Texture \"wall\" \"color\" \"scale\" "
               "\"texture tex1\" \"brick\""),
       {"not defined: \"brick\"", "did you mean \"bricks\"?"}},
      {InWorld("Texture \"t\" \"float\" \"constant\" Material \"matte\" \"texture Kd\" \"t\" "
               "Shape \"sphere\""),
       {"needs a color texture, and \"t\" is a float texture"}},
      {std::string("Camera \"perspective\" \"string name\" \"a") + '\0' + "b\"",
       {"scene.pbrt:1:38: error: a NUL byte in a string\n"}},
  });
}

TEST(Messages, OfPluginsAndParameters) {
  ExpectTexts({
      {InWorld("Shape \"sphare\""),
       {"error: there is no shape \"sphare\"; available: cone, cylinder, disk, ", "looked in ",
        "    hint: did you mean \"sphere\"?\n"}},
      {InWorld("Material \"platsic\" Shape \"sphere\""),
       {"warning: there is no material \"platsic\": \"matte\" is used instead\n",
        "    hint: did you mean \"plastic\"?\n"}},
      {"Accelerator \"grid\"\n" + InWorld(""), {}},
      {"Sampler \"sobol\"\n" + InWorld(""),
       {"warning: there is no sampler \"sobol\": \"lowdiscrepancy\" is used instead; its points "
        "differ, the picture does not\n"}},
      {"Renderer \"metropolis\"\n" + InWorld(""),
       {"warning: there is no renderer \"metropolis\": integrator \"path\" is used instead; hidden "
        "light is noisier\n"}},
      {InWorld("Shape \"sphere\" \"float raduis\" 2"),
       {"warning: unknown parameter \"raduis\" of shape \"sphere\"\n",
        "    hint: did you mean \"radius\"?\n"}},
      {"SurfaceIntegrator \"path\" \"integer nsamples\" 2\n" + InWorld(""),
       {"note: parameter \"nsamples\" does not apply to integrator \"path\"; another plugin of "
        "this kind has it\n"}},
      {InWorld("Shape \"sphere\" \"string radius\" \"2\""),
       {"warning: parameter \"radius\" of shape \"sphere\" keeps its default: it must be of type "
        "\"float\", not \"string\"\n",
        "    hint: write \"float radius\"\n"}},
      {InWorld("Material \"matte\" \"texture Kd\" \"t\"\n"
               "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"none.tga\""),
       {"parameter \"filename\" of color texture \"imagemap\" names \"",
        "none.tga\", which cannot be read: no such file\n", "    hint: tried "}},
      {InWorld("Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"/tmp\""),
       {"\"imagemap\" names \"/tmp\", which cannot be read: is a directory\n"}},
      {InWorld("LightSource \"infinite\" \"string mapname\" \"none.exr\""),
       {"parameter \"mapname\" of light \"infinite\" names \"",
        "none.exr\", which cannot be read: no such file\n"}},
  });
}

TEST(Messages, OfParametersThatNoLongerExist) {
  for (const std::string integrator : {"exphotonmap", "photonmap"}) {
    const std::string begin = "SurfaceIntegrator \"" + integrator + "\" ";
    ExpectTexts({
        {begin + "\"string radiancemode\" \"irradiance\"\n" + InWorld(""),
         {"error: parameter \"radiancemode\" of integrator ",
          " no longer exists: radiance photons always store exitant radiance\n",
          "    hint: delete it; \"bool radiancephotons\" \"false\" "}},
        {begin + "\"string shortgather\" \"gather\"\n" + InWorld(""),
         {"error: parameter \"shortgather\" of integrator ", "    hint: delete it; "}},
    });
    const BuiltScene built =
        BuildText(begin + "\"string radiancemode\" \"exitant\"\n" + InWorld(""));
    EXPECT_EQ(built.status, int(ExitStatus::Scene));
    EXPECT_TRUE(built.setups.empty());
  }
}

TEST(Messages, OfShapesThatHaveNoSubstitute) {
  ExpectTexts({
      {InWorld("Shape \"curve\""),
       {"error: there is no shape \"curve\"; available: cone, ",
        "    hint: a mesh of the same form can take its place: trianglemesh, plymesh or obj\n"}},
      {InWorld("Shape \"bilinearmesh\""),
       {"error: there is no shape \"bilinearmesh\"; available: cone, ",
        "    hint: two triangles of a trianglemesh can take the place of each patch; "}},
  });
}

TEST(Messages, OfMotion) {
  ExpectTexts({
      {"ActiveTransform EndTime Scale -1 1 1 ActiveTransform All Camera \"perspective\"\n" +
           InWorld(""),
       {"error: the camera cannot move this way: ",
        "    hint: its transformations at StartTime and at EndTime are interpolated\n"}},
      {"ActiveTransform EndTime Rotate 180 0 0 1 ActiveTransform All Camera \"perspective\"\n" +
           InWorld(""),
       {"warning: the camera rotates by half a turn: both directions are equally short\n",
        "    hint: rotate by less, for example 179 degrees\n"}},
      {InWorld("ActiveTransform EndTime Translate 0 0 1 LightSource \"point\""),
       {"error: a light source cannot move; shapes, area lights on them, instances and the camera "
        "can\n",
        "    hint: the transformation is not the same at StartTime and EndTime\n"}},
  });
}

TEST(Messages, OfTheDialectAndTheFile) {
  std::string many;
  for (int i = 0; i < 30; ++i) many += "Shape \"none" + std::to_string(i) + "\"\n";
  ExpectTexts({
      {InWorld(many), {"error: too many errors: the rest of the file is not read\n"}},
      {"Renderer \"sampler\"\n" + InWorld(""),
       {"note: scene language version 2, recognised by Renderer at scene.pbrt:1: LookAt and "
        "defaults follow that version\n",
        "    hint: --dialect v1 keeps the meanings of version 1\n"}},
      {"SearchPath \"/tmp\"\n" + InWorld(""),
       {"note: the scene's SearchPath \"/tmp\" is not searched for plugins\n",
        "    hint: plugins are code that runs with your rights: --allow-scene-plugins allows "
        "this\n"}},
      {InWorld("AreaLightSource \"area\" Texture \"t\" \"float\" \"checkerboard\"\n"
               "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0] "
               "\"texture alpha\" \"t\""),
       {"warning: alpha does not cut holes into a shape that emits\n"}},
  });
  LoadOptions limited;
  limited.limits.textureNodes = 2;
  ExpectTexts({{InWorld("Texture \"a\" \"float\" \"uv\""),
                {"\"uv\" has the kind color texture, not float texture; available: bilerp, "}},
               {InWorld("Texture \"a\" \"float\" \"checkerboard\"\n"
                        "Texture \"b\" \"float\" \"scale\" \"texture tex1\" \"a\" \"texture tex2\" "
                        "\"a\""),
                {"error: texture \"b\" evaluates more than 2 textures a lookup, because textures "
                 "below it are used several times\n",
                 "    hint: --limits texturenodes=N allows N of them\n"}}},
              limited);
}

TEST(Messages, OfParametersWithoutEffectAreVerbose) {
  const std::string scene =
      "Accelerator \"bvh\" \"integer maxnodeprims\" 8 \"string splitmethod\" \"middle\"\n"
      "Camera \"environment\" \"float lensradius\" 1 \"float focaldistance\" 2\n"
      "\"float frameaspectratio\" 3 \"float screenwindow\" [0 1 0 1]\n"
      "WorldBegin Shape \"sphere\" WorldEnd";
  EXPECT_EQ(TextOf(scene).find("maxnodeprims"), std::string::npos);
  Log log(Log::Level::Verbose, Log::Sink::Memory);
  MemorySource source({{"scene.pbrt", scene}});
  LoadOptions options;
  options.isStrict = true;
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  LoadScenes(source, "scene.pbrt", options, log);
  std::string text;
  for (const std::string& message : log.Messages()) text += message;
  EXPECT_NE(
      text.find("parameter \"maxnodeprims\" of accelerator \"bvh\" has no effect: version 2's "
                "size of leaves; the picture does not depend on it"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("parameter \"splitmethod\" of accelerator \"bvh\" has no effect: "),
            std::string::npos);
  for (const char* name : {"lensradius", "focaldistance", "frameaspectratio", "screenwindow"})
    EXPECT_NE(text.find(std::string("parameter \"") + name +
                        "\" of camera \"environment\" has no effect: "),
              std::string::npos)
        << name;
}

// Returns the error of a parameter that a program sets without a scene file.
template <class T>
std::string BindError(const char* type, std::vector<double> numbers,
                      std::vector<std::string> strings) {
  struct Settings {
    T value;
  };
  const ParamTable<Settings> table{Param("value", &Settings::value, "a value")};
  ParsedParam param;
  param.type = type;
  param.name = "value";
  param.numbers = std::move(numbers);
  param.strings = std::move(strings);
  ParamSet params;
  params.Add(param);
  BindContext context;
  context.what = "thing \"a\"";
  try {
    table.Bind(params, context);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Messages, OfParametersWithoutAFile) {
  const std::string subject = "parameter \"value\" of thing \"a\" ";
  EXPECT_EQ(BindError<TexturePtr<Real>>("texture", {}, {"t"}),
            subject + "cannot be a texture here");
  EXPECT_EQ(BindError<Real>("float", {}, {"t"}), subject + "takes numbers, not strings");
  EXPECT_EQ(BindError<std::string>("string", {1}, {}),
            subject + "takes strings in quotes, not numbers");
  EXPECT_EQ(BindError<Spectrum>("xyz", {1, INFINITY, 1}, {}),
            subject + "must be finite numbers, not infinity");
  EXPECT_EQ(BindError<int>("integer", {1.5}, {}), subject + "must be an integer, not 1.5");
#ifndef EXPHOTON_DOUBLE
  EXPECT_EQ(BindError<Real>("float", {1e39}, {}),
            subject + "must be at most 3.4028235e+38 in size, not 1e+39");
#endif
}

TEST(Messages, OfEffects) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  const auto error = [&](const std::string& choice) -> std::string {
    try {
      ChooseEffects(RequiredFeatures(), choice, log);
    } catch (const Error& found) {
      return found.what();
    }
    return "";
  };
  const std::string known =
      "; it takes auto, all or a list such as caustics=off of caustics, indirect, transmission, "
      "specular, glossy, media, filtering, lens, motion, environment";
  EXPECT_EQ(error("caustic=off"),
            "--effects: unknown effect \"caustic\"" + known + "; did you mean \"caustics\"?");
  EXPECT_EQ(error("caustics"), "--effects: \"caustics\" must end in =on or =off" + known);
}

TEST(Messages, OfDamagedGzipData) {
  const std::string path = testing::TempDir() + "exphoton-damaged.pbrt.gz";
  const gzFile out = gzopen(path.c_str(), "wb");
  const std::string text = InWorld("Shape \"sphere\"");
  gzwrite(out, text.data(), unsigned(text.size()));
  gzclose(out);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(12);
  file.write("\xff\xff\xff\xff", 4);
  file.close();
  FileSource source;
  try {
    source.Read(path, false);
    FAIL() << "no error";
  } catch (const SourceError& error) {
    EXPECT_STREQ(error.what(), "is damaged: its gzip data cannot be decompressed");
  }
}

}  // namespace
}  // namespace exphoton
