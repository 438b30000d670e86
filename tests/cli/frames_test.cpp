// SPDX-License-Identifier: BSD-2-Clause
// These tests render animations frame by frame (--frames).
#include <cstdlib>
#include <filesystem>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

// A sphere that crosses the picture between the times 0 and 4.
std::string MovingScene(double open, double close, const std::string& picture) {
  return "LookAt 0 0 -5 0 0 0 0 1 0\n"
         "Camera \"perspective\" \"float fov\" 40 \"float shutteropen\" " +
         std::to_string(open) + " \"float shutterclose\" " + std::to_string(close) +
         "\nFilm \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string "
         "filename\" \"" +
         picture +
         "\"\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\nTransformTimes 0 4\n"
         "SurfaceIntegrator \"directlighting\"\nWorldBegin\n"
         "LightSource \"point\" \"point from\" [2 3 -3] \"color I\" [30 30 30]\n"
         "ActiveTransform EndTime\nTranslate 2 0 0\nActiveTransform All\nTranslate -1 0 0\n"
         "Shape \"sphere\" \"float radius\" .5\nWorldEnd\n";
}

class FramesTest : public ProgramTest {
 protected:
  FramesTest() { Write("move.pbrt", MovingScene(0, .5, "move%02d.exr")); }
  void ExpectUsageError(const Names& arguments, const std::string& reason) const {
    const ProgramResult result = Run(arguments);
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
  }
  // Runs a command of the shell in the test's folder.
  int Shell(const std::string& command) const {
    return std::system(("cd '" + Path("") + "' && " + command + " >out.txt 2>&1").c_str());
  }
};

TEST_F(FramesTest, EachFrameIsExposedLater) {
  const ProgramResult result = Run({"move.pbrt", "--frames", "1-3", "--reproducible"});
  EXPECT_EQ(result.status, 0) << result.err;
  for (int frame = 1; frame <= 3; ++frame) {
    Write("one.pbrt", MovingScene(frame - 1, frame - .5, "one.exr"));
    EXPECT_EQ(Run({"one.pbrt"}).status, 0);
    const std::string name = "move0" + std::to_string(frame) + ".exr";
    ASSERT_TRUE(Exists(name));
    // The attributes of the pictures differ: they name the scene.
    const ProgramResult compared =
        Run({"compare", name, "one.exr", "--max-mean", "0", "--max-relmse", "0"});
    EXPECT_EQ(compared.status, 0) << compared.out << compared.err;
  }
  EXPECT_NE(Read("move01.exr"), Read("move02.exr"));
}

TEST_F(FramesTest, AnotherTimeBetweenFrames) {
  EXPECT_EQ(Run({"move.pbrt", "--frames", "5", "--frame-time", ".25", "--reproducible"}).status, 0);
  EXPECT_EQ(Run({"move.pbrt", "--frames", "2", "--reproducible"}).status, 0);
  EXPECT_EQ(Read("move05.exr"), Read("move02.exr"));
}

TEST_F(FramesTest, NumberedScenesKeepTheirOwnTimes) {
  Write("scene3.pbrt", MovingScene(0, .5, "a.exr"));
  const ProgramResult result =
      Run({"scene%d.pbrt", "--frames", "3", "-o", "b%d.exr", "--reproducible"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Run({"scene3.pbrt", "-o", "b3.again.exr", "--reproducible"}).status, 0);
  EXPECT_EQ(Read("b3.exr"), Read("b3.again.exr"));
}

TEST_F(FramesTest, AFrameThatFailsDoesNotStopTheOthers) {
  Write("scene1.pbrt", "nonsense");
  Write("scene2.pbrt", MovingScene(0, 0, "a.exr"));
  const ProgramResult result = Run({"scene%d.pbrt", "--frames", "1-2", "-o", "b%d.exr"});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_TRUE(Exists("b2.exr"));
}

TEST_F(FramesTest, PhotonsServeAllFramesOfAMovingCamera) {
  Write("still.pbrt",
        SmallScene("SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 300 "
                   "\"integer causticphotons\" 0 \"integer finalgathersamples\" 4"));
  ASSERT_EQ(Run({"photons", "still.pbrt", "-o", "still.expm"}).status, 0);
  const ProgramResult still =
      Run({"still.pbrt", "--photons", "still.expm", "--frames", "1-2", "-o", "still%d.exr"});
  EXPECT_EQ(still.status, 0) << still.err;
  // Photons of moving shapes are of one exposure.
  const Names photons{"--integrator", "photonmap", "--set",
                      "SurfaceIntegrator.indirectphotons=300"};
  Names shoot{"photons", "move.pbrt", "-o", "move.expm"},
      render{"move.pbrt", "--frames", "2", "--photons", "move.expm"};
  shoot.insert(shoot.end(), photons.begin(), photons.end());
  render.insert(render.end(), photons.begin(), photons.end());
  ASSERT_EQ(Run(shoot).status, 0);
  const ProgramResult moved = Run(render);
  EXPECT_EQ(moved.status, 1) << moved.err;
  EXPECT_NE(moved.err.find("the exposure is 0 to 0.5 there, 1 to 1.5 here"), std::string::npos)
      << moved.err;
}

TEST_F(FramesTest, PartsOfFramesDoNotMix) {
  for (const char* frame : {"1", "2"})
    ASSERT_EQ(Run({"move.pbrt", "--frames", frame, "--shard", std::string(frame) + "/2", "-o",
                   "parts%d/"})
                  .status,
              0);
  std::filesystem::rename(Path("parts2/part-2-of-2.state"), Path("parts1/part-2-of-2.state"));
  const ProgramResult merged = Run({"merge", "parts1/", "-o", "merged.exr"});
  EXPECT_EQ(merged.status, 1) << merged.err;
  EXPECT_NE(merged.err.find("the time of the frame"), std::string::npos) << merged.err;
}

TEST_F(FramesTest, WrongUseIsAnError) {
  ExpectUsageError({"move.pbrt", "--frames", "3-1"}, "ends before it begins");
  for (const char* wrong : {"", "a", "1-", "-1", "1-2-3", "1.5", "1-2000000"})
    ExpectUsageError({"move.pbrt", std::string("--frames=") + wrong}, "--frames");
  ExpectUsageError({"move.pbrt", "--frame-time", "2"}, "--frame-time needs --frames");
  ExpectUsageError({"move.pbrt", "move.pbrt", "--frames", "1"}, "one scene");
  ExpectUsageError({"-", "--frames", "1"}, "standard input");
  ExpectUsageError({"move.pbrt", "--frames", "1", "-o", "a.exr"}, "-o \"a.exr\" has no place");
  ExpectUsageError({"move.pbrt", "--frames", "1", "--set", "Film.filename=a.exr"}, "has no place");
  ExpectUsageError({"move.pbrt", "--frames", "1", "--stats-json", "a"}, "--stats-json \"a\"");
  Write("a.pbrt", MovingScene(0, 1, "a.exr"));
  const ProgramResult result = Run({"a.pbrt", "--frames", "1"});
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_NE(result.err.find("a.pbrt:3:"), std::string::npos) << result.err;
  EXPECT_FALSE(Exists("a.exr"));
}

// The scripts of an array run here one after the other, without a scheduler.
TEST_F(FramesTest, TasksOfAnArrayRenderFrames) {
  const Names cluster{"cluster", "move.pbrt", "--frames", "1-3", "-o",
                      "m%d.exr", "--",        "--spp",    "1",   "--reproducible"};
  ASSERT_EQ(Run(cluster).status, 0);
  EXPECT_EQ(Shell("PATH= /bin/sh m.exr.parts/merge.sh"), 127 << 8);  // there is no sbatch
  for (const char* frame : {"3", "1", "2"})
    EXPECT_EQ(Shell(std::string("SLURM_ARRAY_TASK_ID=") + frame + " sh m.exr.parts/task.sh"), 0);
  EXPECT_EQ(Shell("PATH= /bin/sh m.exr.parts/merge.sh"), 0);
  EXPECT_EQ(Read("out.txt"), "all frames are rendered\n");
  EXPECT_EQ(
      Run({Path("move.pbrt"), "--frames", "3", "-o", "n%d.exr", "--spp", "1", "--reproducible"})
          .status,
      0);
  EXPECT_TRUE(Read("m3.exr") == Read("n3.exr"));
  const ProgramResult again = Run(cluster);
  EXPECT_EQ(again.status, 3) << again.err;
  EXPECT_NE(again.err.find("\"m1.exr\" exists"), std::string::npos) << again.err;
  ExpectUsageError({"cluster", "move.pbrt", "-o", "a.exr"}, "either --shards N or --frames A-B");
}

}  // namespace
}  // namespace exphoton
