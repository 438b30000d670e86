// SPDX-License-Identifier: BSD-2-Clause
// These tests check that scenes/language-tour uses every directive, type and plugin of version 1,
// and that it renders with every integrator under --strict.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/base/log.h"
#include "core/parser/language_page.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
const fs::path kTour = fs::path(EXPHOTON_SOURCE_DIR) / "scenes/language-tour";

// Returns the text of all scene files of the tour, without comments.
std::string TextOfTour() {
  std::string text;
  for (const fs::directory_entry& entry : fs::directory_iterator(kTour)) {
    if (entry.path().extension() != ".pbrt") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      if (line.find('#') == std::string::npos) text += line + '\n';
  }
  return text;
}

TEST(LanguageTour, UsesEveryDirectiveTypeAndPluginOfVersion1) {
  const std::string text = TextOfTour();
  for (const char* directive : {"Identity",
                                "Translate",
                                "Scale",
                                "Rotate",
                                "LookAt",
                                "Transform [",
                                "ConcatTransform",
                                "CoordinateSystem",
                                "CoordSysTransform",
                                "PixelFilter",
                                "Film",
                                "Sampler",
                                "Accelerator",
                                "SurfaceIntegrator",
                                "VolumeIntegrator",
                                "Camera",
                                "SearchPath",
                                "WorldBegin",
                                "WorldEnd",
                                "AttributeBegin",
                                "AttributeEnd",
                                "TransformBegin",
                                "TransformEnd",
                                "Texture",
                                "Material",
                                "LightSource",
                                "AreaLightSource",
                                "Shape",
                                "ReverseOrientation",
                                "Volume",
                                "ObjectBegin",
                                "ObjectEnd",
                                "ObjectInstance",
                                "Include"})
    EXPECT_NE(text.find(directive), std::string::npos) << directive;
  for (const char* type :
       {"integer", "float", "bool", "point", "vector", "normal", "color", "string", "texture"})
    EXPECT_NE(text.find('"' + std::string(type) + ' '), std::string::npos) << type;
  for (const PbrtPlugin& plugin : PbrtPlugins()) {
    // "grid" is replaced by "bvh", which --strict refuses.
    if (plugin.versions == "2" || plugin.name == "grid") continue;
    EXPECT_NE(text.find('"' + plugin.name + '"'), std::string::npos)
        << plugin.kind << ' ' << plugin.name;
  }
}

// Loads the scenes of a file of the tour, in a quarter of the given resolution.
// `log` must outlive the scenes.
std::vector<LoadedScene> LoadTour(const std::string& file, LoadOptions options, Log& log) {
  options.isStrict = true;
  options.isQuick = true;
  options.pluginFolders.push_back(std::string(EXPHOTON_BINARY_DIR) + "/plugins");
  FileSource source;
  std::vector<LoadedScene> scenes;
  for (auto& setup : LoadScenes(source, (kTour / file).string(), options, log))
    scenes.push_back(
        {std::make_unique<Log>(Log::Level::Quiet, Log::Sink::Memory), std::move(setup)});
  return scenes;
}

void ExpectPicture(LoadedScene& scene) {
  const TestRender render = RenderLoaded(scene);
  EXPECT_TRUE(render.result.isComplete);
  const double mean = MeanRadiance(render.image);
  EXPECT_GT(mean, .01) << scene.setup->integratorName;
  EXPECT_LT(mean, 2) << scene.setup->integratorName;
}

TEST(LanguageTour, RendersWithEveryIntegrator) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  for (const char* integrator :
       {"whitted", "directlighting", "path", "guidedpath", "bidirectional", "photonmap",
        "exphotonmap", "igi", "irradiancecache", "ambientocclusion", "debug"}) {
    SCOPED_TRACE(integrator);
    LoadOptions options;
    options.integrator = integrator;
    options.parameters = {{"Film", "xresolution", "48"}, {"Film", "yresolution", "36"}};
    std::vector<LoadedScene> scenes = LoadTour("path.pbrt", options, log);
    ASSERT_EQ(scenes.size(), 1u);
    ExpectPicture(scenes[0]);
  }
}

TEST(LanguageTour, RendersAllOfItsWorlds) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  LoadOptions options;
  options.parameters = {{"Film", "xresolution", "48"}, {"Film", "yresolution", "36"}};
  std::vector<LoadedScene> scenes = LoadTour("worlds.pbrt", options, log);
  ASSERT_EQ(scenes.size(), 5u);
  for (LoadedScene& scene : scenes) ExpectPicture(scene);
}

TEST(LanguageTour, HasAVariantForEachPhotonMapAndPathTracer) {
  Log log(Log::Level::Quiet, Log::Sink::Memory);
  for (const char* variant : {"exphotonmap", "photonmap", "path", "directlighting", "whitted"}) {
    const std::vector<LoadedScene> scenes = LoadTour(std::string(variant) + ".pbrt", {}, log);
    ASSERT_EQ(scenes.size(), 1u);
    EXPECT_EQ(scenes[0].setup->integratorName, variant);
  }
}

}  // namespace
}  // namespace exphoton
