// SPDX-License-Identifier: BSD-2-Clause
// These tests run studies of scenes and settings with something wrong, and read the messages.
#include <filesystem>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class StudyMessages : public ProgramTest {
 protected:
  StudyMessages() { Write("box.pbrt", SmallScene()); }

  ProgramResult Study(const std::string& scene, const Names& more) const {
    Names words{"study", scene, "--no-maps", "--seeds", "2", "--out", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return Run(words);
  }
  static int Count(const std::string& part, const std::string& text) {
    int count = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
    return count;
  }
};

// A study that is continued shows the warnings of its earlier renders too.
TEST_F(StudyMessages, ShowEachWarningOfTheRendersOnce) {
  Write("glas.pbrt", SmallScene("", "Material \"glas\""));
  const Names settings{"--integrators", "path", "--vary", "spp=1,2"};
  for (int run = 0; run < 2; ++run) {
    const ProgramResult result = Study("glas.pbrt", settings);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Count("there is no material \"glas\"", result.err), 1) << result.err;
    ExpectIn("hint: did you mean \"glass\"?", result.err);
  }
  EXPECT_EQ(Count("there is no material &quot;glas&quot;", Read("out/report.html")), 1);
  const ProgramResult right = Run({"study", "box.pbrt", "--no-maps", "--seeds", "1", "--out",
                                   "right", "--integrators", "path", "--vary", "spp=1"});
  ExpectNotIn("warning", right.err);
  ExpectNotIn("Warnings", Read("right/report.html"));
}

// Warnings that differ in numbers alone are the same.
TEST_F(StudyMessages, ShowTheShareOfACutDepthOnce) {
  Write("deep.pbrt", SmallRoom());
  const ProgramResult result = Study(
      "deep.pbrt", {"--setting", "path maxdepth=1 spp=4", "--setting", "path maxdepth=1 spp=8"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Count("the depth limit \"maxdepth\" cut", result.err), 1) << result.err;
}

TEST_F(StudyMessages, CheckAllSettingsBeforeTheFirstRender) {
  const auto refused = [this](const Names& settings, int status, const std::string& text) {
    for (const Names& plan : {Names{}, Names{"--plan"}}) {
      Names words = settings;
      words.insert(words.end(), plan.begin(), plan.end());
      const ProgramResult result = Study("box.pbrt", words);
      EXPECT_EQ(result.status, status) << result.err;
      ExpectIn(text, result.err);
      ExpectNotIn("[1/", result.err);
    }
    EXPECT_FALSE(Exists("out/results.json"));
  };
  refused({"--integrators", "path", "--vary", "spp=1,x"}, 1, "--spp: \"x\" is not a whole number");
  refused({"--integrators", "exphotonmap", "--vary", "nused=50,-3"}, 1,
          "\"nused\" of integrator \"exphotonmap\" must be between 2 and 100000, not -3");
}

// Only the render reads the photon maps.
TEST_F(StudyMessages, ShowTheCommandAndTheMessagesOfARenderThatFails) {
  Write("maps.expm", "no photons");
  const ProgramResult result = Study("box.pbrt", {"--integrators", "exphotonmap", "--vary", "spp=1",
                                                  "--photons", "maps.expm", "--seeds", "1"});
  EXPECT_EQ(result.status, 3) << result.err;
  ExpectIn("a render of the study failed (status 3): exphoton render box.pbrt", result.err);
  ExpectIn("--photons maps.expm", result.err);
  ExpectIn("exphoton: error: cannot use the photons \"maps.expm\"", result.err);
}

TEST_F(StudyMessages, NameAFolderOfTasksThatIsNone) {
  const Names settings{"--integrators", "path", "--vary", "spp=1"};
  std::filesystem::create_directory(Path("empty"));
  for (const auto& [folder, text] : {std::pair{"nosuch", "cannot read the folder \"nosuch\""},
                                     {"box.pbrt", "cannot read the folder \"box.pbrt\""},
                                     {"empty", "the folder \"empty\" has no results of tasks"}}) {
    Names words = settings;
    words.insert(words.end(), {"--from", folder});
    const ProgramResult result = Study("box.pbrt", words);
    EXPECT_EQ(result.status, 3) << result.err;
    ExpectIn(text, result.err);
    EXPECT_FALSE(Exists("out/results.json"));
  }
}

TEST_F(StudyMessages, RefuseAReferenceThatIsGivenTwice) {
  ASSERT_EQ(Run({"box.pbrt", "--seed", "1001", "-o", "a.exr"}).status, 0);
  const ProgramResult result = Study("box.pbrt", {"--integrators", "path", "--vary", "spp=1",
                                                  "--reference", "a.exr", "--reference", "a.exr"});
  EXPECT_EQ(result.status, 1) << result.err;
  ExpectIn("both halves of the reference have the same pixels", result.err);
}

}  // namespace
}  // namespace exphoton
