// SPDX-License-Identifier: BSD-2-Clause
// These tests write the scripts of `exphoton cluster` and run them one after the other, without a
// scheduler.
#include <cstdlib>

#include "tests/cli/long/names.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

class ClusterScripts : public ProgramTest {
 protected:
  ClusterScripts() { Write("scene.pbrt", SmallScene()); }
  ProgramResult Cluster(const Names& more) const {
    return Run(Names{"cluster", "scene.pbrt"} + more);
  }
  void ExpectRefused(int status, const Names& arguments, const std::string& reason) const {
    const ProgramResult result = Cluster(arguments);
    EXPECT_EQ(result.status, status) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
  }
  // Returns the exit status of a command of the shell in the test's folder.
  int Shell(const std::string& command) const {
    const int status =
        std::system(("cd '" + Path("") + "' && " + command + " >out.txt 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // Runs a task of the array whose scripts are in the folder.
  void RunTask(const std::string& folder, int index) const {
    EXPECT_EQ(Shell("SLURM_ARRAY_TASK_ID=" + std::to_string(index) + " sh " + folder + "/task.sh"),
              0)
        << Read("out.txt");
  }
  // Without sbatch, the script can end the work but submit no task.
  int RunMergeScript(const std::string& folder) const {
    return Shell("PATH= /bin/sh " + folder + "/merge.sh");
  }
};

TEST_F(ClusterScripts, PartsOfAnEarlierRunAreNotMergedAsANewPicture) {
  const Names cluster{"--shards", "2", "-o", "a.exr"};
  ASSERT_EQ(Cluster(cluster).status, 0);
  ASSERT_EQ(Cluster(cluster).status, 0) << "a folder without parts is refused";
  RunTask("a.exr.parts", 1);
  const std::string part = "a.exr.parts/parts/part-1-of-2.state";
  ASSERT_TRUE(Exists(part));
  const std::string task = Read("a.exr.parts/task.sh"), merge = Read("a.exr.parts/merge.sh");
  for (const Names& more : {Names{"--", "--seed", "2"}, Names{"--", "--spp", "9"}, Names{}})
    ExpectRefused(3, cluster + more, "the part \"" + part + "\" exists");
  ExpectRefused(3, {"--shards", "3", "-o", "a.exr", "--submit"}, "run merge.sh again");
  EXPECT_EQ(Read("a.exr.parts/task.sh"), task);
  EXPECT_EQ(Read("a.exr.parts/merge.sh"), merge);
  EXPECT_EQ(Cluster(cluster + Names{"--folder", "other", "--", "--seed", "2"}).status, 0);
  // The first work continues.
  EXPECT_EQ(RunMergeScript("a.exr.parts"), 127);
  RunTask("a.exr.parts", 2);
  EXPECT_EQ(RunMergeScript("a.exr.parts"), 0) << Read("out.txt");
  EXPECT_TRUE(Exists("a.exr"));
}

TEST_F(ClusterScripts, TasksTakeTheThreadsThatTheUserStates) {
  for (const Names& threads : {Names{"--nthreads", "2"}, Names{"--nthreads=2"},
                               Names{"--ncores", "2"}, Names{"--ncores=2"}}) {
    const Names cluster{"--shards", "1", "-o", "a.exr", "--folder", "jobs", "--"};
    ASSERT_EQ(Cluster(cluster + threads).status, 0) << threads[0];
    EXPECT_EQ(Read("jobs/task.sh").find("SLURM_CPUS_ON_NODE"), std::string::npos) << threads[0];
    RunTask("jobs", 1);
    EXPECT_EQ(RunMergeScript("jobs"), 0) << Read("out.txt");
    Remove("jobs/parts/part-1-of-1.state");
  }
  ASSERT_EQ(Cluster({"--frames", "1", "-o", "b%d.exr", "--", "--nthreads", "2"}).status, 0);
  RunTask("b.exr.parts", 1);
  EXPECT_TRUE(Exists("b1.exr"));
  ASSERT_EQ(Cluster({"--shards", "1", "-o", "c.exr"}).status, 0);
  EXPECT_NE(Read("c.exr.parts/task.sh").find("--nthreads \"${SLURM_CPUS_ON_NODE:-0}\""),
            std::string::npos);
}

TEST_F(ClusterScripts, AFolderWithATooLongNameIsNamed) {
  const std::string name(300, 'a');
  ExpectRefused(3, {"--shards", "2", "-o", "a.exr", "--folder", name},
                "cannot use \"" + name + "/parts\": File name too long\n");
}

TEST_F(ClusterScripts, APictureThatNoMergeCanWriteIsRefusedBeforeAnyTask) {
  const std::string ending = "ends neither in .exr nor in .png";
  for (const char* name : {"a.jpg", "a", "a.exr.gz"})
    ExpectRefused(1, {"--shards", "2", "-o", name},
                  "the picture \"" + std::string(name) + "\" " + ending);
  ExpectRefused(1, {"--frames", "1-2", "-o", "a%d.jpg"}, ending);
  ExpectRefused(1, {"--shards", "2", "-o", "a.png", "--", "--aov", "albedo"},
                "a PNG has no layers for --aov");
  ExpectRefused(1, {"--shards", "2", "-o", "a.png", "--", "--float"}, "a PNG has 8 bits");
  ExpectRefused(1, {"--shards", "2", "-o", "a.exr", "--", "--stats-json", "s.json"},
                "--stats-json names one file, but every shard would write it");
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
  for (const char* option : {"--check", "--explain"})
    ExpectRefused(1, {"--shards", "2", "-o", "a.exr", "--", option},
                  std::string(option) + " is not for the options after --");
  ExpectRefused(1, {"--shards", "2", "-o", "a.exr", "--", "--integrator", "nosuch"}, "\"nosuch\"");
  EXPECT_EQ(Cluster({"--shards", "2", "-o", "a.PNG"}).status, 0);
  EXPECT_EQ(Cluster({"--shards", "2", "-o", "a.exr", "--", "--aov", "albedo", "--float"}).status,
            0);
}

TEST_F(ClusterScripts, AFaultySceneIsRefusedBeforeAnyTask) {
  Write("scene.pbrt", "LookAt 1 2");
  ExpectRefused(2, {"--shards", "2", "-o", "a.exr"}, "LookAt takes 9 numbers");
  EXPECT_EQ(Files(), Names{"scene.pbrt"});
}

}  // namespace
}  // namespace exphoton
