// SPDX-License-Identifier: BSD-2-Clause
// These tests check that feature culling drops only features that contribute nothing. With and
// without it, the project's scenes must give the same pictures, bit for bit.
#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <fstream>
#include <sstream>

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
                                         "glossy-room", "glossy-floor-room", "veach-mis",
                                         "moving-spheres"),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// Returns the box of cornell-caustic as text, without the blocks that use one of the materials.
std::string CausticBoxWithout(const std::vector<std::string>& materials) {
  std::ifstream file(std::string(EXPHOTON_SOURCE_DIR) + "/scenes/cornell-caustic/geometry.pbrt");
  std::ostringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  for (const std::string& material : materials) {
    const std::size_t wears = text.find(material);
    EXPECT_NE(wears, std::string::npos) << material;
    const std::size_t begin = text.rfind("AttributeBegin", wears);
    const std::size_t end = text.find("AttributeEnd", wears) + std::string("AttributeEnd").size();
    text.erase(begin, end - begin);
  }
  return "LookAt 1.5 1.5 7.1 1.5 1.42 0 0 1 0 Camera \"perspective\" \"float fov\" 37.5 Film "
         "\"image\" \"integer xresolution\" 8 \"integer yresolution\" 6 Sampler \"lowdiscrepancy\" "
         "\"integer pixelsamples\" 1 SurfaceIntegrator \"exphotonmap\" \"integer "
         "causticphotons\" 3000 \"integer indirectphotons\" 3000\nWorldBegin\n" +
         text + "WorldEnd\n";
}

const std::string kGlassBall = "\"glass\"", kMirrorBall = "\"color Kr\" [ .92 .92 .92 ]",
                  kGoldRing = "\"color Kr\" [ .95 .72 .35 ]";

TEST(CausticBox, WithoutBallsAndRingShootsNoCausticPhotonAndSaysWhy) {
  LoadedScene scene = LoadSceneText(CausticBoxWithout({kGlassBall, kMirrorBall, kGoldRing}));
  const RequiredFeatures& plan = scene.setup->scene->Features();
  EXPECT_FALSE(plan.Needs(Feature::Caustics));
  EXPECT_EQ(plan.Get(Feature::Caustics).reason, "no specular surface");
  const TestRender render = RenderLoaded(scene);
  EXPECT_TRUE(std::isnan(render.Counter("photons/caustic paths")));
  EXPECT_TRUE(std::isnan(render.Counter("photons/caustic stored")));
  EXPECT_GE(render.Counter("photons/indirect stored"), 3000);
  // Only the indirect and direct maps determine the number of photons shot.
  EXPECT_EQ(render.Counter("photons/shot"), std::max(render.Counter("photons/indirect paths"),
                                                     render.Counter("photons/direct paths")));
  EXPECT_GT(MeanRadiance(render.image), .01);
}

TEST(CausticBox, WithoutTheBallsStillHasTheCausticOfTheRing) {
  LoadedScene scene = LoadSceneText(CausticBoxWithout({kGlassBall, kMirrorBall}));
  EXPECT_TRUE(scene.setup->scene->Features().Needs(Feature::Caustics));
  EXPECT_GE(RenderLoaded(scene).Counter("photons/caustic stored"), 3000);
}

TEST(CausticBox, AsItIsHasCaustics) {
  LoadedScene scene = LoadSceneText(CausticBoxWithout({}));
  EXPECT_TRUE(scene.setup->scene->Features().Needs(Feature::Caustics));
  EXPECT_GE(RenderLoaded(scene).Counter("photons/caustic stored"), 3000);
}

}  // namespace
}  // namespace exphoton
