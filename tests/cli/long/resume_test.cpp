// SPDX-License-Identifier: BSD-2-Clause
// These tests stop the program and continue with --resume: messages, files and refusals. Random
// moments are in tests/safety/resume.cpp.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <thread>

#include "core/imaging/files/exr.h"
#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class ResumedProgram : public ProgramTest {
 protected:
  ResumedProgram() { Write("scene.pbrt", Scene()); }

  static std::string Scene(const std::string& world = "") {
    return SmallScene(
        "Film \"image\" \"integer xresolution\" 60 \"integer yresolution\" 40 \"string filename\" "
        "\"out.exr\" Sampler \"lowdiscrepancy\" \"integer pixelsamples\" 2048",
        world);
  }
  static Names Command(const Names& more) {
    Names words{"scene.pbrt", "--reproducible", "--nthreads", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  // Sends a signal while pixels are rendered. Returns the result of the program.
  ProgramResult Stop(const Names& words, int signal, double seconds = .5) {
    const pid_t process = Start(words);
    EXPECT_TRUE(WaitForMessage("effects"));
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(process, signal);
    return Wait(process);
  }
};

TEST_F(ResumedProgram, ContinuesToTheSameBytes) {
  const ProgramResult stopped = Stop(Command({}), SIGINT);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  ExpectIn("with --resume continues from \"out.exr.state\"", stopped.err);
  EXPECT_EQ(Files(), (Names{"out.exr.state", "out.partial.exr", "scene.pbrt"}));
  // Outputs, threads and messages may be others.
  // The default filter renders 2 pixels on each side of the picture.
  const ProgramResult resumed =
      Run({"scene.pbrt", "--reproducible", "--resume", "--verbose", "--stats-json", "s.json"});
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  ExpectIn("continuing \"out.exr.state\"", resumed.err);
  ExpectIn("\"render/camera samples\":" + std::to_string(64 * 44 * 2048), Read("s.json"));
  EXPECT_EQ(Files(), (Names{"out.exr", "s.json", "scene.pbrt"}));
  const std::string picture = Read("out.exr");
  EXPECT_EQ(Run(Command({})).status, 0);
  EXPECT_EQ(Read("out.exr"), picture);
}

// The same command with --resume would render the complete pictures again.
TEST_F(ResumedProgram, NamesTheFramesAndScenesThatRemain) {
  Write("scene1.pbrt", SmallScene());
  Write("scene2.pbrt", Scene());
  const auto stopIn = [this](const Names& words, const std::string& picture) {
    const pid_t process = Start(words);
    EXPECT_TRUE(WaitForMessage("wrote \"" + picture + "\""));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(process, SIGINT);
    return Wait(process).err;
  };
  const Names frames{"scene%d.pbrt", "--frames", "1-3", "-o", "f%d.exr", "--nthreads", "1"};
  ExpectIn("the same command with --frames 2-3 --resume continues from \"f2.exr.state\"",
           stopIn(frames, "f1.exr"));
  Write("first.pbrt",
        SmallScene("Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6 "
                   "\"string filename\" \"first.exr\""));
  ExpectIn(
      "the same command with --resume, without the scenes before \"scene.pbrt\", continues "
      "from \"out.exr.state\"",
      stopIn({"first.pbrt", "scene.pbrt", "--nthreads", "1"}, "first.exr"));
}

TEST_F(ResumedProgram, WithoutAStateItBegins) {
  const ProgramResult result = Run(Command({"--resume", "--spp", "1"}));
  EXPECT_EQ(result.status, 0);
  ExpectIn("there is no state \"out.exr.state\": rendering from the start", result.err);
}

TEST_F(ResumedProgram, NamesEverySettingThatDiffers) {
  Stop(Command({"--seed", "3", "--state", "mine.state"}), SIGTERM);
  ASSERT_TRUE(Exists("mine.state"));
  const std::string state = Read("mine.state");
  const ProgramResult result =
      Run(Command({"--resume", "--state", "mine.state", "--spp", "8", "--aov", "N", "--set",
                   "SurfaceIntegrator.maxdepth=3"}));
  EXPECT_EQ(result.status, 1) << result.err;
  ExpectIn("--aov is not given there, N here; ", result.err);
  ExpectIn("--seed is 3 there, 0 here; ", result.err);
  ExpectIn("--set SurfaceIntegrator.maxdepth is not given there, 3 here; ", result.err);
  ExpectIn("--spp is not given there, 8 here", result.err);
  EXPECT_EQ(result.err.find("--filter"), std::string::npos);
  EXPECT_EQ(Read("mine.state"), state);
  EXPECT_FALSE(Exists("out.exr"));
}

TEST_F(ResumedProgram, RefusesAnotherSceneAndChangedFiles) {
  Write("grey.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'));
  const std::string textured =
      "Texture \"grey\" \"color\" \"imagemap\" \"string filename\" \"grey.pfm\"\nMaterial "
      "\"matte\" \"texture Kd\" \"grey\"\n";
  Write("scene.pbrt", Scene(textured));
  Stop(Command({}), SIGINT);
  ASSERT_TRUE(Exists("out.exr.state"));
  Write("grey.pfm", "PF\n1 1\n-1\n" + std::string(11, '\0') + "\x3f");
  const ProgramResult changed = Run(Command({"--resume"}));
  EXPECT_EQ(changed.status, 1);
  ExpectIn("the file \"grey.pfm\" has changed since", changed.err);
  Write("scene.pbrt", "# a comment is no change\n" + Scene(textured));
  ExpectIn("the file \"grey.pfm\"", Run(Command({"--resume"})).err);
  Write("scene.pbrt", Scene());
  ExpectIn("the scene \"scene.pbrt\" has changed since", Run(Command({"--resume"})).err);
  Write("other.pbrt", Scene());
  const ProgramResult other = Run({"other.pbrt", "--resume"});
  EXPECT_EQ(other.status, 1);
  ExpectIn("another scene: \"scene.pbrt\" there, \"other.pbrt\" here", other.err);
  EXPECT_TRUE(Exists("out.exr.state"));
}

TEST_F(ResumedProgram, RefusesDamagedStates) {
  Stop(Command({}), SIGHUP);
  const std::string whole = Read("out.exr.state");
  ASSERT_GT(whole.size(), 1000u);
  for (int i = 0; i < 10; ++i) {
    std::string damaged = whole;
    const std::size_t at = whole.size() * std::size_t(i) / 10 + 17;
    if (i % 2 == 0)
      damaged.resize(at);
    else
      damaged[at] = char(damaged[at] ^ 16);
    Write("out.exr.state", damaged);
    const ProgramResult result = Run(Command({"--resume"}));
    EXPECT_EQ(result.status, 3) << result.err;
    ExpectIn("cannot continue from \"out.exr.state\": it is ", result.err);
    EXPECT_EQ(Read("out.exr.state"), damaged);
  }
  Write("out.exr.state", whole);
  EXPECT_EQ(Run(Command({"--resume"})).status, 0);
}

TEST_F(ResumedProgram, OverwritesNoOtherFile) {
  Write("out.exr.state", "my notes");
  const ProgramResult stopped = Stop(Command({}), SIGINT);
  EXPECT_EQ(stopped.status, 130);
  ExpectIn("\"out.exr.state\" exists and is not a state", stopped.err);
  EXPECT_EQ(Read("out.exr.state"), "my notes");
  const ProgramResult result = Run(Command({"--resume"}));
  EXPECT_EQ(result.status, 3);
  ExpectIn("not the state of a stopped render", result.err);
  EXPECT_EQ(Run(Command({"--state", "scene.pbrt"})).status, 3);
  EXPECT_EQ(Read("out.exr.state"), "my notes");
}

TEST_F(ResumedProgram, KeepsTheStateOfARenderThatIsNotContinued) {
  Stop(Command({}), SIGINT);
  const std::string older = Read("out.exr.state");
  ASSERT_FALSE(older.empty());
  const ProgramResult again = Stop(Command({}), SIGINT, .2);
  ExpectIn("\"out.exr.state\" is the state of a stopped render, which this command does not",
           again.err);
  ExpectIn("the older state is kept as \"out.exr.state.old\"", again.err);
  EXPECT_EQ(Read("out.exr.state.old"), older);
  EXPECT_TRUE(Exists("out.exr.state"));
  EXPECT_EQ(Run(Command({"--resume", "--state", "out.exr.state.old"})).status, 0);
  EXPECT_EQ(Files(), (Names{"out.exr", "out.exr.state", "scene.pbrt"}));
}

TEST_F(ResumedProgram, KeepsTheStatesOfAllRendersThatAreNotContinued) {
  const auto stop = [this] { return Stop(Command({}), SIGINT, .2); };
  stop();
  const std::string first = Read("out.exr.state");
  EXPECT_EQ(stop().err.find("--state"), std::string::npos);
  const std::string second = Read("out.exr.state");
  const ProgramResult third = stop();
  ExpectIn("--resume continues it; --resume --state \"out.exr.state.old\" continues an older one",
           third.err);
  ExpectIn("the older state is kept as \"out.exr.state.old-2\"", third.err);
  EXPECT_EQ(Read("out.exr.state.old"), first);
  EXPECT_EQ(Read("out.exr.state.old-2"), second);
  EXPECT_TRUE(Exists("out.exr.state"));
}

TEST_F(ResumedProgram, WritesThePictureSoFar) {
  const Names words = Command({"--write-every", ".2s", "--aov", "samples"});
  const pid_t process = Start(words);
  for (int i = 0; i < 600 && !Exists("out.partial.exr"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(process, SIGKILL);
  Wait(process);
  const Image picture = ReadExr(Path("out.partial.exr"));
  EXPECT_EQ(picture.Width(), 60);
  EXPECT_EQ(picture.At(0, 0, picture.FindChannel("samples.count")), 2048);
  EXPECT_EQ(picture.At(59, 39, picture.FindChannel("samples.count")), 0);
  EXPECT_TRUE(Exists("out.exr.state"));
  const ProgramResult resumed = Run(Command({"--resume", "--aov", "samples"}));
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  ExpectIn("continuing", resumed.err);
  EXPECT_FALSE(Exists("out.exr.state"));
  EXPECT_FALSE(Exists("out.partial.exr"));
}

TEST_F(ResumedProgram, AFullFolderLosesNoRender) {
  // A folder in place of the state cannot be written.
  mkdir(Path("out.exr.state").c_str(), 0700);
  const ProgramResult stopped = Stop(Command({}), SIGINT);
  EXPECT_EQ(stopped.status, 130);
  ExpectIn("the state of this render is not written", stopped.err);
  EXPECT_TRUE(Exists("out.partial.exr"));
}

TEST_F(ResumedProgram, ATimeLimitCountsAllRuns) {
  Stop(Command({"--time-limit", "4s", "--spp", "100000"}), SIGINT, 2);
  ASSERT_TRUE(Exists("out.exr.state"));
  const ProgramResult resumed = Run(Command({"--time-limit", "4s", "--spp", "100000", "--resume"}));
  EXPECT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_LT(resumed.seconds, 3.8);
}

}  // namespace
}  // namespace exphoton
