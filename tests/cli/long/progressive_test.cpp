// SPDX-License-Identifier: BSD-2-Clause
// These tests render progressive passes: their bias falls, and each has one time.
#include <cmath>

#include "core/imaging/files/exr.h"
#include "tests/cli/long/names.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class Progressive : public ProgramTest {
 protected:
  // A wall with the sharp edge of a spot light, 16 x 4 pixels. Photons blur the edge.
  static std::string EdgeScene() {
    return "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 4\n"
           "Camera \"orthographic\" \"float screenwindow\" [ -2 2 -.5 .5 ]\n"
           "Sampler \"random\" \"integer xsamples\" 2 \"integer ysamples\" 2\n"
           "PixelFilter \"box\" SurfaceIntegrator \"photonmap\" \"bool directwithphotons\" "
           "\"true\"\n"
           "\"bool finalgather\" \"false\" \"integer directphotons\" 500 \"integer "
           "indirectphotons\" "
           "0\n"
           "WorldBegin\nLightSource \"spot\" \"point from\" [ 0 0 0 ] \"point to\" [ 0 0 4 ]\n"
           "\"float coneangle\" 14 \"float conedeltaangle\" .1 \"color I\" [ 9 9 9 ]\n"
           "Translate 0 0 4 Scale 9 9 1 ReverseOrientation Shape \"disk\"\nWorldEnd\n";
  }
  // A glowing square that moves over the picture, 16 x 4 pixels.
  static std::string MovingScene() {
    return "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 4\n"
           "\"bool premultiplyalpha\" \"false\"\n"
           "Camera \"orthographic\" \"float screenwindow\" [ -2 2 -.5 .5 ]\n"
           "Sampler \"random\" \"integer xsamples\" 2 \"integer ysamples\" 2\n"
           "PixelFilter \"box\" SurfaceIntegrator \"photonmap\" \"integer indirectphotons\" 50\n"
           "WorldBegin\nAreaLightSource \"area\" \"color L\" [ 1 1 1 ] Material \"matte\" \"color "
           "Kd\" [ 0 0 0 ]\n"
           "ActiveTransform EndTime Translate 3 0 0 ActiveTransform All\n"
           "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" "
           "[ -2 -2 4 -2 2 4 -1 2 4 -1 -2 4 ]\nWorldEnd\n";
  }
  std::vector<float> Render(const Names& more) const {
    const ProgramResult result =
        Run(Names{"scene.pbrt", "--float", "--reproducible", "-o", "out.exr"} + more);
    EXPECT_EQ(result.status, 0) << result.err;
    return ReadExr(Path("out.exr")).pixels;
  }
  static double MeanSquare(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - double(b[i]), 2);
    return sum / double(a.size());
  }
  void ExpectRefused(const Names& more, const std::string& reason) const {
    const ProgramResult result = Run(Names{"scene.pbrt", "-o", "refused.exr"} + more);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
    EXPECT_FALSE(Exists("refused.exr"));
  }
};

// 800 passes have next to no noise, so what remains with fixed radii is their blur of the edge.
TEST_F(Progressive, PassesLoseTheBlurOfTheKernel) {
  Write("scene.pbrt", EdgeScene());
  const auto truth = Render({"--integrator", "directlighting", "--spp", "1024"});
  const Names passes{"--progressive", "--max-passes", "800"};
  const double fixed = MeanSquare(Render(passes + Names{"--progressive-alpha", "1"}), truth);
  EXPECT_LT(MeanSquare(Render(passes), truth), .5 * fixed);
  EXPECT_LT(MeanSquare(Render(passes), truth),
            .2 * MeanSquare(Render({"--progressive", "--max-passes", "8"}), truth));
}

TEST_F(Progressive, PassesSeeOneTimeEach) {
  Write("scene.pbrt", MovingScene());
  int covered = 0, partly = 0;
  const auto picture = Render({"--progressive", "--max-passes", "1"});
  for (std::size_t x = 0; x < 16; ++x) {
    const float value = picture[4 * x];
    covered += value == 1;
    partly += value > 0 && value < 1;
  }
  EXPECT_GE(covered, 3);  // the square is four pixels wide
  EXPECT_LE(partly, 2);   // its rims
  const auto mean = Render({"--progressive", "--max-passes", "256"});
  for (std::size_t x = 4; x < 12; ++x) EXPECT_NEAR(mean[4 * x], 1. / 3, .02) << x;
}

TEST_F(Progressive, RendersAreEqualForAnyNumberOfThreads) {
  Write("scene.pbrt", EdgeScene());
  const Names passes{"--progressive", "--max-passes", "5"};
  const auto picture = Render(passes + Names{"--nthreads", "1"});
  EXPECT_EQ(Render(passes + Names{"--nthreads", "3"}), picture);
  EXPECT_NE(Render(passes + Names{"--progressive-alpha", ".1"}), picture);
}

TEST_F(Progressive, OptionsThatCannotWorkAreRefused) {
  Write("scene.pbrt", EdgeScene());
  const Names passes{"--progressive", "--max-passes", "5"};
  ExpectRefused({"--progressive"}, "needs --time-limit");
  ExpectRefused(passes + Names{"--integrator", "path"}, "no radii to shrink");
  ExpectRefused(passes + Names{"--certify"}, "exclude each other");
  ExpectRefused(passes + Names{"--shard", "1/2"}, "exclude each other");
  ExpectRefused(passes + Names{"--progressive-alpha", "0"}, "above 0");
  ExpectRefused({"--max-passes", "5"}, "--max-passes needs");
}

TEST_F(Progressive, PassesAreASettingOfStudies) {
  Write("scene.pbrt", EdgeScene());
  const Names study{"study",  "scene.pbrt", "--integrators", "photonmap,directlighting",
                    "--vary", "passes=2,8", "--seeds",       "1",
                    "--out",  "out",        "--no-maps"};
  const ProgramResult result = Run(study);
  ASSERT_EQ(result.status, 0) << result.err;
  const std::string results = Read("out/results.json");
  for (const char* part : {"--progressive --max-passes 2", "--progressive --max-passes 8"})
    EXPECT_NE(results.find(part), std::string::npos) << part;
  EXPECT_TRUE(Exists("out/images/directlighting_seed=1.exr"));  // it has no passes
  EXPECT_EQ(Run(study + Names{"--vary", "directlighting:passes=3"}).status, 1);
}

}  // namespace
}  // namespace exphoton
