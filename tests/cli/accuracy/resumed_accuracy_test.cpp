// SPDX-License-Identifier: BSD-2-Clause
// These tests kill renders with an accuracy or a certificate after each state that they write, and
// continue them. The pictures must have the bytes of renders that nothing stopped.
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/cli/program.h"

namespace exphoton {
namespace {

using Names = std::vector<std::string>;

class ResumedAccuracy : public ProgramTest {
 protected:
  static Names Command(const Names& words, const Names& more) {
    Names all = words;
    all.insert(all.end(), {"--reproducible", "--no-progress", "-o", "room.exr"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  // Starts the render and kills it after it has written another state, later than the message if
  // there is one. Returns whether there is such a state. The picture may be complete before.
  bool KillAfterState(const Names& words, const char* threads, const std::string& message = "") {
    std::string before = State();
    const pid_t process =
        Start(Command(words, {"--resume", "--write-every", ".05s", "--nthreads", threads}));
    if (!message.empty()) {
      EXPECT_TRUE(WaitForMessage(message));
      before = State();
    }
    bool hasState = false;
    for (int i = 0; i < 6000 && !hasState && !Exists("room.exr"); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      hasState = !State().empty() && State() != before;
    }
    if (!Exists("room.exr")) kill(process, SIGKILL);  // otherwise it removes its state and ends
    Wait(process);
    return hasState;
  }
  std::string State() const { return Exists("room.exr.state") ? Read("room.exr.state") : ""; }

  // Returns the bytes of a picture that nothing stopped, and removes its file.
  std::string WholePicture(const Names& words) {
    const ProgramResult whole = Run(Command(words, {"--nthreads", "1"}));
    EXPECT_EQ(whole.status, 0) << whole.err;
    std::string picture = Read("room.exr");
    Remove("room.exr");
    return picture;
  }
  // Continues the render, and expects these messages and this picture.
  void ExpectContinued(const Names& words, const std::string& message, const std::string& picture) {
    const ProgramResult last = Run(Command(words, {"--resume", "--nthreads", "2"}));
    ASSERT_EQ(last.status, 0) << last.err;
    ExpectIn(message, last.err);
    ExpectIn("continuing \"room.exr.state\"", last.err);
    EXPECT_TRUE(Read("room.exr") == picture);
    EXPECT_FALSE(Exists("room.exr.state"));
    EXPECT_FALSE(Exists("room.partial.exr"));
  }

  // Compares a render that is killed several times with one that is not. Returns the messages of
  // the latter.
  std::string ExpectSameBytes(const Names& words) {
    const ProgramResult whole = Run(Command(words, {"--nthreads", "1"}));
    EXPECT_EQ(whole.status, 0) << whole.err;
    const std::string picture = Read("room.exr");
    Remove("room.exr");
    int killed = 0;
    for (int i = 0; i < 4 && !Exists("room.exr"); ++i)
      killed += KillAfterState(words, i % 2 == 0 ? "1" : "2") ? 1 : 0;
    EXPECT_GE(killed, 1);
    if (!Exists("room.exr")) {
      const ProgramResult last = Run(Command(words, {"--resume", "--nthreads", "2"}));
      EXPECT_EQ(last.status, 0) << last.err;
      EXPECT_NE(last.err.find("continuing \"room.exr.state\""), std::string::npos) << last.err;
    }
    EXPECT_TRUE(Read("room.exr") == picture);
    EXPECT_FALSE(Exists("room.exr.state"));
    EXPECT_FALSE(Exists("room.partial.exr"));
    return whole.err;
  }
};

const Names kShared{"room.pbrt",    "--integrator", "exphotonmap", "--accuracy", "3%",
                    "--resolution", "48x32",        "--seed",      "2"};

TEST_F(ResumedAccuracy, SharedGathersContinue) {
  Write("room.pbrt", SmallRoom());
  ExpectSameBytes(kShared);
}

TEST_F(ResumedAccuracy, GuidedPathsContinue) {
  Write("room.pbrt", SmallRoom());
  ExpectSameBytes(
      {"room.pbrt", "--integrator", "guidedpath", "--accuracy", "3%", "--aov", "variance,direct"});
}

TEST_F(ResumedAccuracy, PicturesThatStopSharingContinue) {
  const std::string scene = EXPHOTON_SOURCE_DIR "/scenes/skylight-room/exphotonmap.pbrt";
  ExpectIn("gathers shared -> not shared",
           ExpectSameBytes({scene, "--accuracy", "4%", "--resolution", "32x24", "--seed", "1",
                            "--integrator", "exphotonmap", "--set",
                            "SurfaceIntegrator.finalgathersamples=16"}));
}

// The bias of 10 photons is too large, so the picture begins again with more of them.
TEST_F(ResumedAccuracy, MorePhotonsContinue) {
  std::string room = SmallRoom();
  const std::string photons = "\"integer indirectphotons\" 500";
  ASSERT_NE(room.find(photons), std::string::npos) << room;
  room.replace(room.find(photons), photons.size(), "\"integer indirectphotons\" 10");
  Write("room.pbrt", room);
  const Names words{"room.pbrt", "--integrator", "exphotonmap", "--accuracy", "3%", "--seed", "4"};
  const std::string picture = WholePicture(words);
  ASSERT_TRUE(KillAfterState(words, "1", "rendered again with"));
  // The state of another render does not change the photons.
  const ProgramResult other = Run(Command(words, {"--resume", "--set", "Sampler.pixelsamples=8"}));
  EXPECT_EQ(other.status, 1) << other.err;
  ExpectIn("--set Sampler.pixelsamples is not given there, 8 here", other.err);
  EXPECT_EQ(other.err.find("had begun again"), std::string::npos) << other.err;
  ExpectContinued(words, "the stopped render had begun again with", picture);
}

TEST_F(ResumedAccuracy, SecondChoicesContinue) {
  Write("room.pbrt", RoomWithAHiddenLamp());
  const Names words{"room.pbrt", "--accuracy", "20%", "--seed", "1"};
  const std::string picture = WholePicture(words);
  ASSERT_TRUE(KillAfterState(words, "1", "another choice is made"));
  ExpectContinued(words, "the stopped render had begun again with another choice", picture);
}

TEST_F(ResumedAccuracy, CertificatesContinue) {
  Write("room.pbrt", SmallRoom());
  const Names words{"room.pbrt",    "--certify", "--integrator", "exphotonmap",
                    "--resolution", "48x32",     "--spp",        "128"};
  ExpectIn("error ", ExpectSameBytes(words));
}

TEST_F(ResumedAccuracy, RefusesAnotherAccuracyAndDamagedStates) {
  Write("room.pbrt", SmallRoom());
  ASSERT_TRUE(KillAfterState(kShared, "1"));
  const std::string whole = State();
  Names other = kShared;
  other[4] = "6%";
  const ProgramResult coarser = Run(Command(other, {"--resume"}));
  EXPECT_EQ(coarser.status, 1) << coarser.err;
  ExpectIn("--accuracy is 3% there, 6% here", coarser.err);
  const ProgramResult fixed =
      Run(Command({"room.pbrt", "--integrator", "exphotonmap"}, {"--resume"}));
  EXPECT_EQ(fixed.status, 1) << fixed.err;
  ExpectIn("--accuracy is 3% there, not given here", fixed.err);
  EXPECT_TRUE(State() == whole);
  for (int i = 0; i < 3; ++i) {
    std::string damaged = whole;
    const std::size_t at = whole.size() * std::size_t(i) / 3 + 40;
    if (i == 0)
      damaged.resize(at);
    else
      damaged[at] = char(damaged[at] ^ 16);
    Write("room.exr.state", damaged);
    const ProgramResult result = Run(Command(kShared, {"--resume"}));
    EXPECT_EQ(result.status, 3) << result.err;
    ExpectIn("cannot continue from \"room.exr.state\": it is ", result.err);
  }
}

// How many samples a group has depends on a clock, so the state decides.
TEST_F(ResumedAccuracy, ATimeLimitKeepsItsFirstSamples) {
  Write("room.pbrt", SmallRoom());
  Names words = kShared;
  words[4] = "1%";
  words.insert(words.end(), {"--time-limit", "1000s"});
  ASSERT_TRUE(KillAfterState(words, "1"));
  // With less time or more threads, pilots alone would choose other groups.
  words.back() = "2s";
  const ProgramResult result = Run(Command(words, {"--resume", "--nthreads", "2"}));
  EXPECT_EQ(result.status, 0) << result.err;
  ExpectIn("continuing \"room.exr.state\"", result.err);
}

}  // namespace
}  // namespace exphoton
