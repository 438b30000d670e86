// SPDX-License-Identifier: BSD-2-Clause
// The plan of effects drops only what is provably nothing: with and without it our scenes are the
// same pictures, bit for bit.
#include <gtest/gtest.h>

#include "tests/images/reference.h"

namespace exphoton {
namespace {

std::vector<float> PixelsOf(const std::string& variant, const std::string& effects) {
  LoadOptions load;
  load.effects = effects;
  load.isQuick = true;
  load.pixelBounds = PixelBounds{0, 0, 16, 12};
  for (const char* count : {"causticphotons", "indirectphotons"})
    if (variant.find("photonmap") != std::string::npos)
      load.parameters.push_back({"SurfaceIntegrator", count, "5000"});
  if (variant.find("photonmap") != std::string::npos)
    load.parameters.push_back({"SurfaceIntegrator", "maxphotonpaths", "100000"});
  LoadedScene scene = LoadSceneFile(variant, load);
  TestRenderOptions options;
  options.threads = 2;
  return RenderLoaded(scene, options).image.pixels;
}

class PlanTest : public testing::TestWithParam<std::string> {};

TEST_P(PlanTest, LeavesThePictureAlone) {
  for (const char* integrator : {"exphotonmap", "photonmap", "path", "directlighting", "whitted"}) {
    const std::string variant = GetParam() + "/" + integrator;
    const std::vector<float> planned = PixelsOf(variant, "auto");
    EXPECT_EQ(planned.size(), 4u * 16 * 12);
    EXPECT_EQ(planned, PixelsOf(variant, "all")) << variant;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PlanTest,
                         testing::Values("skylight-room", "cornell-caustic", "furnace",
                                         "glossy-room", "veach-mis"),
                         [](const auto& info) {
                           return info.param.substr(0, info.param.find('-'));
                         });

}  // namespace
}  // namespace exphoton
