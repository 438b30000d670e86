// SPDX-License-Identifier: BSD-2-Clause
// These tests run a study as tasks, by processes as a cluster would start them.
#include <cstdlib>
#include <filesystem>

#include "tests/cli/long/names.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

namespace fs = std::filesystem;
class StudyTasks : public ProgramTest {
 protected:
  StudyTasks() {
    Write("box.pbrt", SmallScene());
    fs::create_directory(Path("out.tasks"));
  }
  static Names Study(const Names& more = {}) {
    return Names{"study",
                 "box.pbrt",
                 "--integrators",
                 "path,directlighting",
                 "--vary",
                 "spp=1,2",
                 "--seeds",
                 "2",
                 "--make-reference",
                 "path",
                 "--reference-time",
                 "1s",
                 "--no-maps"} +
           more;
  }
  ProgramResult Task(int index, int count, const Names& more = {}) const {
    const std::string number = std::to_string(index);
    return Run(
        Study({"--task", number + "/" + std::to_string(count), "--out", "out.tasks/" + number}) +
        more);
  }
  std::string Missing(int count) const {
    const ProgramResult result =
        Run(Study({"--from", "out.tasks", "--missing", std::to_string(count)}));
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  }
};

TEST_F(StudyTasks, GiveTheRendersOfOneProcess) {
  EXPECT_EQ(Missing(3), "0,1,2,3\n");
  for (const int index : {2, 0, 3}) EXPECT_EQ(Task(index, 3).status, 0);
  EXPECT_EQ(Missing(3), "1\n");
  EXPECT_EQ(Task(1, 3).status, 0);
  EXPECT_NE(Task(1, 3).err.find("3 renders existed already"), std::string::npos);
  EXPECT_EQ(Missing(3), "");
  const ProgramResult result = Run(Study({"--from", "out.tasks", "--out", "out"}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.err.find("8 renders existed already"), std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("reference:"), std::string::npos) << "made again: " << result.err;
  EXPECT_NE(result.out.find("ran as tasks on 1 machine. Their times are not comparable"),
            std::string::npos)
      << result.out;
  EXPECT_EQ(Run(Study({"--out", "one"})).status, 0);
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(Path("one/images"))) {
    if (entry.path().extension() != ".exr") continue;
    const std::string name = "images/" + entry.path().filename().string();
    EXPECT_EQ(Read("out/" + name), Read("one/" + name)) << name;
    ++pictures;
  }
  EXPECT_EQ(pictures, 8);
}

TEST_F(StudyTasks, DamagedAndForeignRendersAreMadeAgain) {
  for (const int index : {1, 2}) EXPECT_EQ(Task(index, 2, {"--alone"}).status, 0);
  EXPECT_EQ(Missing(2), "0\n");
  const std::string picture = "out.tasks/2/images/path_spp=2_seed=1.exr";
  const std::string bytes = Read(picture);
  ASSERT_FALSE(bytes.empty());
  Write(picture, bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(Missing(2), "0,2\n");
  Write("box.pbrt", SmallScene("PixelFilter \"box\""));
  EXPECT_EQ(Missing(2), "0,1,2\n");
}

TEST_F(StudyTasks, ScriptsRunTheTasksAndTheStudy) {
  const ProgramResult made = Run(Study({"--out", "out", "--tasks", "2"}));
  ASSERT_EQ(made.status, 0) << made.err;
  const auto shell = [&](const std::string& command) {
    return std::system(("cd '" + Path("") + "' && " + command + " >shell.txt 2>&1").c_str());
  };
  EXPECT_NE(Read("out.tasks/task.sh").find("#SBATCH --exclusive"), std::string::npos);
  for (const char* task : {"0", "1", "2"})
    EXPECT_EQ(shell(std::string("SLURM_ARRAY_TASK_ID=") + task + " sh out.tasks/task.sh"), 0)
        << Read("shell.txt");
  EXPECT_EQ(shell("sh out.tasks/merge.sh"), 0) << Read("shell.txt");
  EXPECT_TRUE(Exists("out/report.html"));
  EXPECT_NE(Read("shell.txt").find("Each render had its machine for itself"), std::string::npos)
      << Read("shell.txt");
}

TEST_F(StudyTasks, WrongUseIsAnError) {
  const std::pair<Names, std::string> wrong[] = {
      {{"--task", "3/2", "--out", "a"}, "--task takes I/N"},
      {{"--task", "x", "--out", "a"}, "--task takes I/N"},
      {{"--task", "1/2", "--tasks", "2", "--out", "a"}, "exclude each other"},
      {{"--submit", "--out", "a"}, "--submit and --sbatch need --tasks"},
      {{"--alone", "--out", "a"}, "--alone needs --task"},
      {{"--missing", "2", "--out", "a"}, "--missing needs --from"},
      {{"--tasks", "2", "--sbatch", "x", "--out", "a"}, "an option of sbatch"},
  };
  for (const auto& [options, reason] : wrong) {
    const ProgramResult result = Run(Study(options));
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
  }
  const ProgramResult result =
      Run({"study", "box.pbrt", "--task", "0/2", "--out", "a", "--integrators", "path"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_NE(result.err.find("the study makes none"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace exphoton
