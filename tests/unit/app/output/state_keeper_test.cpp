// SPDX-License-Identifier: BSD-2-Clause
// These tests follow the state of a picture that begins again with other settings, and the choice
// of --accuracy that its identity names.
#include "core/app/output/state_keeper.h"

#include <gtest/gtest.h>

#include "core/app/commands/scene_names.h"
#include "core/app/dial/dial.h"
#include "tests/support/process.h"
#include "tests/support/test_scene.h"

namespace exphoton::cli {
namespace {

class StateKeeperTest : public testing::Test {
 protected:
  StateKeeperTest()
      : scene_(LoadSceneText(TestHeader("\"path\"", 4, 4, 1) + "WorldBegin WorldEnd")) {
    command_.accuracy = .05;
    command_.dial = DialChoice{};
    command_.dial->firstSamples = 8;
    command_.dial->settings = {500, 0, .25, 16};
    command_.dial->mayRaisePhotons = true;
    command_.load.parameters = command_.dial->settings.Overrides();
  }

  StateKeeper::Settings Settings() const {
    StateKeeper::Settings settings;
    settings.path = folder_.File("a.state");
    settings.start = StateKeeper::Clock::now();
    settings.picturePath = folder_.File("a.partial.exr");
    settings.writePicture = [this](const PictureSoFar&) {
      WriteFile(folder_.File("a.partial.exr"), "a picture");
    };
    return settings;
  }
  StateIdentity Identity() const { return StateIdentity(command_, *scene_.setup); }
  static void Write(StateKeeper* keeper, const std::string& text) {
    Checkpoint checkpoint;
    checkpoint.hasWork = true;
    checkpoint.save = [text](StateWriter* writer) { writer->Add("text", text); };
    checkpoint.picture = [] { return PictureSoFar{Film({0, 0, 1, 1}, {0, 0, 1, 1}), nullptr, {}}; };
    keeper->Take(checkpoint, false);
  }

  const TestFolder folder_;
  LoadedScene scene_;
  RenderCommand command_;
  Log log_{Log::Level::Verbose, Log::Sink::Memory};
};

// The second attempt replaces the state of the first one, and does not keep it as an older state.
TEST_F(StateKeeperTest, ASecondAttemptTakesOverTheFiles) {
  const StateIdentity first = Identity();
  StateKeeper::Attempt attempt;
  {
    StateKeeper keeper(Settings(), first, log_);
    EXPECT_EQ(keeper.Resume(), nullptr);
    Write(&keeper, "first");
    attempt = keeper.ThisAttempt();
  }
  StateKeeper::Settings again = Settings();
  again.earlier = attempt;
  again.resumes = true;  // the state is of the first attempt, so it is not read
  ASSERT_TRUE(RaisePhotons(1, &command_, log_));
  const StateIdentity second = Identity();
  StateKeeper keeper(again, second, log_);
  EXPECT_EQ(keeper.Resume(), nullptr);
  EXPECT_TRUE(keeper.HasWritten());
  EXPECT_EQ(StateFile(again.path).Get("text"), "first");
  // Until then the note after a stop says that the state is an earlier one.
  command_.scenes = {"a.pbrt"};
  const std::string note = "the same command with --resume continues from \"" + again.path + "\"";
  EXPECT_EQ(ResumeText(command_, "a.pbrt", keeper),
            note + ", the state before the picture began again");
  Write(&keeper, "second");
  EXPECT_EQ(ResumeText(command_, "a.pbrt", keeper), note);
  EXPECT_EQ(StateFile(again.path).Get("text"), "second");
  EXPECT_EQ(folder_.Names(), (std::vector<std::string>{"a.partial.exr", "a.state"}));
  keeper.Remove();
  EXPECT_TRUE(folder_.Names().empty());
}

TEST_F(StateKeeperTest, AnotherAttemptKeepsTheTimeOfEarlierRuns) {
  const StateIdentity identity = Identity();
  StateKeeper::Settings settings = Settings();
  settings.earlier = StateKeeper::Attempt{70, false, ""};
  const StateKeeper keeper(settings, identity, log_);
  EXPECT_EQ(keeper.EarlierSeconds(), 70);
  EXPECT_FALSE(keeper.HasWritten());
}

TEST_F(StateKeeperTest, TheIdentityNamesTheChoice) {
  ASSERT_TRUE(RaisePhotons(1, &command_, log_));
  const RenderCommand raised = command_;
  StateWriter writer(folder_.File("a.state"));
  Identity().Save(&writer);
  writer.Commit();
  const auto later = StateIdentity::Of(StateFile(folder_.File("a.state"))).Choice();
  ASSERT_TRUE(later);
  EXPECT_EQ(later->photons, 1);
  EXPECT_EQ(later->firstSamples, 8);
  command_.dial->firstSamples = 16;
  EXPECT_EQ(StateIdentity(raised, *scene_.setup).Differences(Identity()),
            "the samples of a group for --accuracy is 16 there, 8 here");
  command_.accuracy.reset(), command_.dial.reset();
  StateWriter other(folder_.File("b.state"));
  Identity().Save(&other);
  other.Commit();
  EXPECT_FALSE(StateIdentity::Of(StateFile(folder_.File("b.state"))).Choice());
}

// The pilots of a continued render choose the photons of the first attempt again.
TEST_F(StateKeeperTest, AContinuedRenderTakesTheLaterChoice) {
  RenderCommand raised = command_;
  ASSERT_TRUE(RaisePhotons(1, &raised, log_));
  ASSERT_TRUE(RaisePhotons(1, &raised, log_));
  EXPECT_EQ(raised.dial->settings.photons, 4);
  RenderCommand continued = command_;
  EXPECT_TRUE(ContinueChoice({8, 4}, &continued, log_));
  EXPECT_EQ(continued.dial->text, raised.dial->text);
  EXPECT_EQ(StateIdentity(continued, *scene_.setup).Differences({raised, *scene_.setup}), "");
  EXPECT_FALSE(ContinueChoice({8, 4}, &continued, log_));
  EXPECT_FALSE(ContinueChoice({32, 4}, &continued, log_));  // pilots decide without a time limit
  continued.timeLimit = 60;
  EXPECT_FALSE(ContinueChoice({0, 4}, &continued, log_));
  EXPECT_FALSE(ContinueChoice({std::int64_t(1) << 62, 4}, &continued, log_));
  EXPECT_TRUE(ContinueChoice({32, 4}, &continued, log_));
  EXPECT_EQ(continued.dial->firstSamples, 32);
  EXPECT_EQ(*continued.load.samplesPerPixel, 32 * 128);
  EXPECT_TRUE(ContinueChoice({32, 1e9}, &continued, log_));
  EXPECT_EQ(continued.dial->settings.photons, 256);
}

}  // namespace
}  // namespace exphoton::cli
