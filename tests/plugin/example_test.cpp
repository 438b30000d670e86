// SPDX-License-Identifier: BSD-2-Clause
// These tests cover the example plugin of docs/development/writing-a-plugin.md. The plugin is built
// outside the program's own plugin folder and is found through PBRT_SEARCHPATH. The page must quote
// the plugin's source verbatim.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/plugins/registry.h"
#include "tests/support/process.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TEST(ExamplePlugin, IsQuotedInTheDocumentationAsItIs) {
  const std::string page = ReadFile(EXPHOTON_SOURCE_DIR "/docs/development/writing-a-plugin.md");
  for (const std::string& name : {std::string("openness"), std::string("velvet")}) {
    const std::string code = ReadFile(EXPHOTON_SOURCE_DIR "/tests/plugin/example/" + name + ".cpp");
    ASSERT_FALSE(code.empty());
    EXPECT_NE(page.find("```cpp\n" + code + "```\n"), std::string::npos)
        << "docs/development/writing-a-plugin.md does not quote tests/plugin/example/" << name;
  }
}

#ifndef EXPHOTON_STATIC_PLUGINS

// The scene is a disk above an endless floor. From the floor point under its centre, a disk of
// radius r at height h covers the fraction r^2 / (r^2 + h^2) of the cosine-weighted hemisphere.
TEST(ExamplePlugin, RendersFromPbrtSearchpath) {
  setenv("PBRT_SEARCHPATH", EXPHOTON_BINARY_DIR "/example_plugins", 1);
  TestRenderOptions options;
  options.load.pluginFolders = PluginRegistry::DefaultFolders({});
  unsetenv("PBRT_SEARCHPATH");
  const auto openness = [&](const std::string& parameters) {
    const TestRender render = RenderSceneText(
        R"(LookAt 0 .5 0  0 0 0  0 0 1
           Camera "perspective" "float fov" .01
           Film "image" "integer xresolution" 1 "integer yresolution" 1
           PixelFilter "box"
           Accelerator "bruteforce"
           Sampler "lowdiscrepancy" "integer pixelsamples" 64
           SurfaceIntegrator "openness" "integer nsamples" 256 )" +
            parameters + R"(
           WorldBegin
           AttributeBegin
           Rotate -90 1 0 0
           Shape "disk" "float radius" 1000
           Shape "disk" "float radius" 1 "float height" 1
           AttributeEnd
           WorldEnd)",
        options);
    return MeanRadiance(render.image);
  };
  // The 16384 directions are stratified. Independent directions would give a standard
  // error of 0.004.
  EXPECT_NEAR(openness(""), .5, .01);
  EXPECT_EQ(openness("\"float reach\" .9"), 1);
}

#endif

}  // namespace
}  // namespace exphoton
