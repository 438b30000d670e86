// SPDX-License-Identifier: BSD-2-Clause
// These tests check how a study changes its folder. It must not touch a file that no
// study has written.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class StudyFolderTest : public ProgramTest {
 protected:
  StudyFolderTest() { Write("box.pbrt", SmallScene()); }
  Names Options(const std::string& folder, const std::string& scene = "box.pbrt") const {
    return {"study",   scene, "--integrators", "path",  "--vary", "spp=1,2",
            "--seeds", "1",   "--no-maps",     "--out", folder};
  }
  Names All(const std::string& folder) const {
    Names names;
    for (const auto& entry : fs::recursive_directory_iterator(Path(folder)))
      if (!entry.is_directory()) names.push_back(fs::relative(entry, Path(folder)).string());
    return names;
  }
};

TEST_F(StudyFolderTest, AFolderOfOtherFilesIsRefusedAndLeftAlone) {
  fs::create_directories(Path("mine/src"));
  for (const char* name : {"mine/running-notes.txt", "mine/src/running_data.csv",
                           "mine/src/movie.mp4.partial", "mine/results.csv", "mine/report.html"})
    Write(name, name);
  const ProgramResult result = Run(Options("mine"));
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_NE(result.err.find("\"mine\""), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("--out FOLDER"), std::string::npos) << result.err;
  EXPECT_EQ(All("mine").size(), 5u);
  for (const std::string& name : All("mine")) EXPECT_EQ(Read("mine/" + name), "mine/" + name);
}

TEST_F(StudyFolderTest, FilesThatAreAddedToAStudyStay) {
  ASSERT_EQ(Run(Options("out")).status, 0);
  fs::create_directory(Path("out/notes"));
  const Names mine{"out/running-notes.txt", "out/notes/running.pbrt", "out/images/a.partial",
                   "out/images/running.exr"};
  for (const std::string& name : mine) Write(name, name);
  ASSERT_EQ(Run(Options("out")).status, 0);
  fs::remove(Path("out/results.csv"));
  ASSERT_EQ(Run(Options("out")).status, 0);
  for (const std::string& name : mine) EXPECT_EQ(Read(name), name);
  EXPECT_TRUE(Exists("out/results.csv"));
}

TEST_F(StudyFolderTest, DamagedResultsAreNamedAndCanBeMadeAgain) {
  Names one = Options("out");
  one[5] = "spp=1";
  ASSERT_EQ(Run(one).status, 0);
  Write("out/results.json", Read("out/results.json").substr(0, 500));
  const ProgramResult report = Run({"report", "out"});
  EXPECT_EQ(report.status, 3);
  EXPECT_NE(
      report.err.find("in \"out\": results.json is cut off or damaged at byte 501\n    hint: "),
      std::string::npos)
      << report.err;
  EXPECT_EQ(report.err.find("json.exception"), std::string::npos) << report.err;
  Write("out/results.json", "{\"format\": 1}");
  EXPECT_EQ(Run({"report", "out"}).err.find("json.exception"), std::string::npos);
  EXPECT_NE(Run(one).err.find("1 render existed already"), std::string::npos);
  EXPECT_EQ(Run({"report", "out"}).status, 0);
}

TEST_F(StudyFolderTest, ASceneCalledRunningIsNotRemoved) {
  fs::create_directory(Path("out"));
  ASSERT_EQ(Run(Options("out")).status, 0);
  fs::copy_file(Path("box.pbrt"), Path("out/running.pbrt"));
  ASSERT_EQ(Run(Options("out", "out/running.pbrt")).status, 0);
  EXPECT_EQ(Read("out/running.pbrt"), SmallScene());
}

// The folder belongs to a study that has not written its report yet.
TEST_F(StudyFolderTest, AReportOfSomebodyElseIsNotReplaced) {
  fs::create_directories(Path("out/.exphoton-study"));
  Write("out/.exphoton-study/files.txt", "exphoton study 1\n");
  Write("out/report.html", "mine");
  const ProgramResult result = Run(Options("out"));
  EXPECT_EQ(result.status, 3);
  EXPECT_NE(result.err.find("report.html"), std::string::npos) << result.err;
  EXPECT_EQ(Read("out/report.html"), "mine");
}

TEST_F(StudyFolderTest, LinksLeadNoResultOutOfTheFolder) {
  Write("private", "mine");
  ASSERT_EQ(Run(Options("out")).status, 0);
  fs::remove(Path("out/report.html"));
  fs::create_symlink("../private", Path("out/report.html"));
  EXPECT_EQ(Run(Options("out")).status, 3);
  EXPECT_EQ(Run({"report", "out"}).status, 3);
  EXPECT_EQ(Read("private"), "mine");
  fs::remove_all(Path("out/.exphoton-study/running"));
  fs::create_directory(Path("mine"));
  Write("mine/a", "mine");
  fs::create_symlink("../../mine", Path("out/.exphoton-study/running"));
  EXPECT_EQ(Run(Options("out")).status, 3);
  EXPECT_EQ(Read("mine/a"), "mine");
}

TEST_F(StudyFolderTest, TwoStudiesDoNotShareAFolder) {
  Names slow = Options("out");
  slow.insert(slow.end(), {"--vary", "maxdepth=2,3,4,5,6,7", "--seeds", "50"});
  const pid_t process = Start(slow);
  for (int i = 0; i < 600 && !Exists("out/images"); ++i) usleep(10000);
  const std::string line = "cd '" + Path("") + "' && '" + EXPHOTON_BINARY_DIR +
                           "/bin/exphoton' study box.pbrt --out out 2>message >/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(line.c_str())), 3);
  EXPECT_NE(Read("message").find("another study is running"), std::string::npos) << Read("message");
  kill(process, SIGINT);
  EXPECT_EQ(Wait(process).status, 128 + SIGINT);
}

TEST_F(StudyFolderTest, StudiesOfEarlierVersionsGoOn) {
  ASSERT_EQ(Run(Options("out")).status, 0);
  fs::remove_all(Path("out/.exphoton-study"));  // earlier versions did not make this folder
  const ProgramResult again = Run(Options("out"));
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("2 renders existed already"), std::string::npos) << again.err;
  EXPECT_EQ(Run({"report", "out"}).status, 0);
}

TEST_F(StudyFolderTest, ASignalLeavesNothingUnfinished) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGUSR1, SIGALRM, SIGXCPU}) {
    Names slow = Options("out");
    slow.insert(slow.end(), {"--seeds", "40", "--nthreads", "1"});
    const pid_t process = Start(slow);
    ASSERT_TRUE(WaitForMessage("["));
    usleep(50000);
    kill(process, signal);
    EXPECT_EQ(Wait(process).status, 128 + signal);
    for (const std::string& name : All("out")) {
      EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
      EXPECT_EQ(name.find("running"), std::string::npos) << name;
    }
    fs::remove_all(Path("out"));
  }
}

}  // namespace
}  // namespace exphoton
