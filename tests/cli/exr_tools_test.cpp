// SPDX-License-Identifier: BSD-2-Clause
// These tests read pictures with the tools of other programs: exrheader (Debian: openexr) and
// oiiotool (openimageio-tools). They are skipped where these are not installed, but where CI is set
// they fail. ./dev test --browser installs the tools.
#include <cstdlib>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

class ExrToolsTest : public ProgramTest {
 protected:
  // Finds a tool of this Debian package. Skips the test, or fails it, if it is not installed.
  void Find(const std::string& tool, const std::string& package) {
    const ProcessResult found = RunProcess({{"/bin/sh", "-c", "command -v " + tool}, Path("")});
    tool_ = found.status == 0 ? found.out.substr(0, found.out.find('\n')) : "";
    if (!tool_.empty()) return;
    const std::string advice = tool + " is not installed (Debian: " + package +
                               "); ./dev test --browser installs it and runs this test";
    if (std::getenv("CI")) FAIL() << advice;
    GTEST_SKIP() << advice;
  }
  std::string Output(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{tool_};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const ProcessResult result = RunProcess({words, Path("")});
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }
  bool HasTool() const { return !tool_.empty(); }
  void RenderWithAovs() const {
    Write("scene.pbrt", SmallScene("Camera \"perspective\" \"float shutteropen\" .25 \"float "
                                   "shutterclose\" .5"));
    const ProgramResult result =
        Run({"scene.pbrt", "--aov", "albedo,N,Ng,P,Z,uv,objectId,materialId,variance,time"});
    ASSERT_EQ(result.status, 0) << result.err;
  }

 private:
  std::string tool_;
};

void ExpectAllIn(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << text;
}

TEST_F(ExrToolsTest, ExrheaderKnowsTheStandardAttributesAndTheTypesOfChannels) {
  Find("exrheader", "openexr");
  if (!HasTool()) return;
  RenderWithAovs();
  const std::string text = Output({"out.exr"});
  ExpectAllIn(text,
              {"chromaticities (type chromaticities):", "red   (0.64 0.33)", "white (0.3127 0.329)",
               "whiteLuminance (type float): 179", "expTime (type float): 0.25",
               "effects (type string): \"", "time/render (type float):",
               "cpuTime/render (type float):", "worldToNDC (type m44f):"});
  ExpectAllIn(text, {"albedo.R, 16-bit floating-point", "N.X, 16-bit floating-point",
                     "P.X, 32-bit floating-point", "Z, 32-bit floating-point",
                     "uv.U, 32-bit floating-point", "objectId.id, 32-bit floating-point",
                     "materialId.id, 32-bit floating-point", "R, 16-bit floating-point"});
  EXPECT_EQ(text.find("phaseTimes"), std::string::npos);
  const std::size_t effects = text.find("effects (type string)");
  EXPECT_LT(text.find('\n', effects) - effects, 120u) << "effects are names, not a table";
}

TEST_F(ExrToolsTest, OiiotoolKnowsThem) {
  Find("oiiotool", "openimageio-tools");
  if (!HasTool()) return;
  RenderWithAovs();
  const std::string text = Output({"--info", "-v", "out.exr"});
  ExpectAllIn(text, {"chromaticities: 0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329",
                     "whiteLuminance: 179", "ExposureTime: 0.25", "Z (float)", "uv.U (float)"});
}

}  // namespace
}  // namespace exphoton
