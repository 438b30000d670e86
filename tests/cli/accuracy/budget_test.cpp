// SPDX-License-Identifier: BSD-2-Clause
// These tests split the error of a small scene from the command line.
#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Words = std::vector<std::string>;

class BudgetTest : public ProgramTest {
 protected:
  BudgetTest() {
    Write("room.pbrt",
          "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16\n"
          "Camera \"perspective\"\nPixelFilter \"box\"\n"
          "Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\n"
          "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 500 \"integer "
          "finalgathersamples\" 4\n"
          "WorldBegin\nMaterial \"matte\" \"color Kd\" [.3 .3 .3]\nAttributeBegin AreaLightSource "
          "\"area\" \"color L\" [5 5 5]\n"
          "Translate 0 3 4 Shape \"sphere\" AttributeEnd\nTranslate 0 0 4 Shape \"sphere\"\n"
          "ReverseOrientation Shape \"sphere\" \"float radius\" 6\nWorldEnd\n");
  }

  std::string Budget(const Words& more, const std::string& seeds = "3") {
    Words words{"budget", "room.pbrt", "--seeds", seeds, "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }

  // Returns the numbers of the second column by the names of the first one.
  static std::map<std::string, double> ValuesOf(const std::string& text) {
    std::map<std::string, double> values;
    std::istringstream lines(text);
    const std::regex row("  ([a-z][a-z ]*[a-z]) +(-?[0-9.]+)( .*|$)");
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
      if (std::regex_match(line, found, row)) values[found[1]] = std::stod(found[2]);
    return values;
  }
};

TEST_F(BudgetTest, PrintsPartsThatAddUp) {
  const std::string text = Budget({"--reference-spp", "64"});
  auto values = ValuesOf(text);
  double sum = 0;
  for (const char* name :
       {"camera sampling", "gather directions", "photon noise", "blur of the maps",
        "caustic kernel", "sharing", "depth limits", "skipped effects"}) {
    ASSERT_TRUE(values.contains(name)) << name << text;
    sum += values[name];
  }
  const double total = values["sum of the parts"];
  EXPECT_GT(total, 0) << text;
  EXPECT_NEAR(sum, total, .03 * total) << text;
  EXPECT_NEAR(values["difference"], total - values["measured"], .02 * total) << text;
  EXPECT_GT(values["camera sampling"], 0) << text;
  EXPECT_GT(values["gather directions"], 0) << text;
  for (const char* part :
       {"24 x 16 pixels, 2 samples a pixel, exphotonmap", "times the lower bound",
        "no caustic photons", "guidedpath with 64 samples"})
    EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

// With 60 photons and 50 of them in each density estimate, blur is most of the error. It differs so
// much between sets of photons that 16 seeds are needed: half of a 95 % interval of the difference
// is then a quarter of the error.
TEST_F(BudgetTest, FindsTheBlurOfFewPhotons) {
  std::string scene = Read("room.pbrt");
  scene.replace(scene.find("[.3 .3 .3]"), 10, "[.6 .6 .6]");
  Write("room.pbrt", scene);
  auto values = ValuesOf(Budget(
      {"--reference-spp", "256", "--spp", "8", "--set", "SurfaceIntegrator.indirectphotons=60",
       "--set", "SurfaceIntegrator.finalgathersamples=16"},
      "16"));
  const double measured = values["measured"];
  EXPECT_GT(values["blur of the maps"], .7 * measured);
  EXPECT_LT(std::abs(values["difference"]), .3 * measured);
}

TEST_F(BudgetTest, DoesNotDependOnThreads) {
  const auto one = ValuesOf(Budget({"--nthreads", "1", "--block", "4"}));
  EXPECT_GE(one.size(), 11u);
  EXPECT_EQ(one, ValuesOf(Budget({"--nthreads", "3", "--block", "4"})));
}

TEST_F(BudgetTest, NamesCausesThatDoNotOccur) {
  const std::string text =
      Budget({"--integrator", "photonmap", "--set", "SurfaceIntegrator.finalgather=false"});
  EXPECT_NE(text.find("no gather rays"), std::string::npos) << text;
  EXPECT_NE(text.find("gathers are not shared"), std::string::npos) << text;
  EXPECT_NE(text.find("by the certificate"), std::string::npos) << text;
}

TEST_F(BudgetTest, IsOnThePageOfAStudy) {
  const ProgramResult run =
      Run({"study", "room.pbrt", "--integrators", "exphotonmap,path", "--vary", "spp=1", "--seeds",
           "2", "--no-maps", "--error-budget", "--out", "out"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("error budget of exphotonmap"), std::string::npos) << run.err;
  const std::string page = Read("out/report.html");
  EXPECT_NE(page.find("Where the error comes from"), std::string::npos);
  EXPECT_NE(page.find("times the lower bound"), std::string::npos);
  EXPECT_EQ(Run({"report", "out"}).status, 0);
  EXPECT_NE(Read("out/report.html").find("gather directions"), std::string::npos);
  EXPECT_EQ(Run({"study", "room.pbrt", "--integrators", "path", "--error-budget", "--photons", "a",
                 "--out", "none"})
                .status,
            1);
}

TEST_F(BudgetTest, SaysWhatIsWrong) {
  const auto refused = [&](const Words& more, int status) {
    Words words{"budget", "room.pbrt", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = Run(words);
    EXPECT_EQ(result.status, status) << result.err;
    return result.err;
  };
  EXPECT_NE(refused({"--integrator", "path"}, 1).find("no error budget"), std::string::npos);
  refused({"--seeds", "2"}, 1);
  EXPECT_NE(refused({"--reference-spp", "0"}, 1).find("--reference-spp"), std::string::npos);
  EXPECT_NE(refused({"--footprint-spp", "0"}, 1).find("--footprint-spp"), std::string::npos);
  refused({"--effects", "nothing=off"}, 1);
  EXPECT_EQ(Run({"budget", "none.pbrt"}).status, 3);
}

}  // namespace
}  // namespace exphoton
