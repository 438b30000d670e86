// SPDX-License-Identifier: BSD-2-Clause
// These tests measure what effects change in a picture (explain --measure).
#include <regex>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

class ExplainMeasureTest : public ProgramTest {
 protected:
  // A closed furnace: each surface emits e and reflects a = .5, so the radiance is e / (1 - a) and
  // half of the light is scattered.
  void WriteFurnace(const std::string& integrator) const {
    Write("furnace.pbrt",
          "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16\n"
          "Camera \"perspective\"\nPixelFilter \"box\"\n"
          "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 16\n"
          "SurfaceIntegrator \"" +
              integrator +
              "\" \"integer maxdepth\" 60\nWorldBegin\n"
              "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
              "AreaLightSource \"area\" \"color L\" [1 1 1]\nReverseOrientation\n"
              "Shape \"sphere\" \"float radius\" 6\nWorldEnd\n");
  }
  // The number before a text, such as 25 in "adds 25 ± 0.1 % of the light".
  static double Number(const std::string& text, const std::string& pattern) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(text, match, std::regex(pattern))) << pattern << '\n' << text;
    return match.empty() ? -1 : std::stod(match[1]);
  }
};

// Emission has 1/2 of the light, direct light 1/4, and the rest is indirect.
TEST_F(ExplainMeasureTest, SaysWhatEachEffectAdds) {
  WriteFurnace("path");
  const ProgramResult result = Run({"explain", "furnace.pbrt", "--measure"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(Number(result.out, "indirect +adds (\\S+) "), 25, .5);
  EXPECT_NEAR(Number(result.out, "indirect.*picture by (\\S+) %"), 25, .5);
  EXPECT_GT(Number(result.out, "indirect.*takes (\\S+) %"), 20);
  EXPECT_NEAR(Number(result.out, "emission (\\S+) %"), 50, .5);
  EXPECT_NEAR(Number(result.out, "direct (\\S+) %"), 25, .5);
  EXPECT_NEAR(Number(result.out, "together (\\S+) %"), 100, .1);
  EXPECT_EQ(result.out.find("caustics    adds"), std::string::npos);  // no effect of this scene
}

TEST_F(ExplainMeasureTest, WorksWithPhotonMaps) {
  WriteFurnace("exphotonmap");
  const ProgramResult result = Run({"explain", "furnace.pbrt", "--measure"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(Number(result.out, "indirect +adds (\\S+) "), 25, 1);
  EXPECT_NEAR(Number(result.out, "together (\\S+) %"), 100, .1);
}

// Motion switches sharing of gathers off. A render without motion must not share them either.
TEST_F(ExplainMeasureTest, FindsNoLightInMotionOutsideOfThePicture) {
  WriteFurnace("exphotonmap");
  std::string text = Read("furnace.pbrt");
  text.insert(text.find("WorldEnd"),
              "AttributeBegin Translate 500 0 0 ActiveTransform EndTime Translate 1 0 0\n"
              "ActiveTransform All AreaLightSource \"area\" \"color L\" [0 0 0] Shape \"sphere\" "
              "AttributeEnd\n");
  Write("furnace.pbrt", text);
  const ProgramResult result = Run({"explain", "furnace.pbrt", "--measure"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Number(result.out, "motion +adds (\\S+) "), 0);
  EXPECT_EQ(Number(result.out, "motion.*picture by (\\S+) %"), 0);
}

TEST_F(ExplainMeasureTest, OfABlackSceneFindsNoLight) {
  Write("black.pbrt",
        "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
        "Camera \"perspective\"\nSurfaceIntegrator \"path\"\nWorldBegin\n"
        "AreaLightSource \"area\" \"color L\" [0 0 0]\n"
        "Shape \"sphere\" \"float radius\" 6\nWorldEnd\n");
  const ProgramResult result = Run({"explain", "black.pbrt", "--measure", "--effects", "all"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("adds 0 "), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("nan"), std::string::npos) << result.out;
}

// All effects but one are a list that begins with "all".
TEST_F(ExplainMeasureTest, WorksWithAllEffects) {
  WriteFurnace("path");
  const ProgramResult result = Run({"explain", "furnace.pbrt", "--measure", "--effects", "all"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_NEAR(Number(result.out, "indirect +adds (\\S+) "), 25, .5);
  WriteFurnace("exphotonmap");  // which computes "transmission", the longest name
  ExpectIn("  transmission adds ",
           Run({"explain", "furnace.pbrt", "--measure", "--effects", "all"}).out);
}

TEST_F(ExplainMeasureTest, IsRefusedWhereItHasNoMeaning) {
  WriteFurnace("path");
  const ProgramResult render = Run({"furnace.pbrt", "--measure", "-o", "x.exr"});
  EXPECT_EQ(render.status, 1);
  EXPECT_NE(render.err.find("--measure needs exphoton explain"), std::string::npos) << render.err;
  EXPECT_FALSE(Exists("x.exr"));
  Write("two.pbrt", Read("furnace.pbrt") + Read("furnace.pbrt"));
  const ProgramResult two = Run({"explain", "two.pbrt", "--measure"});
  EXPECT_EQ(two.status, 1);
  EXPECT_NE(two.err.find("holds 2 scenes"), std::string::npos) << two.err;
}

}  // namespace
}  // namespace exphoton
