// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/process/interrupt_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/app/process/signals.h"

namespace exphoton::cli {
namespace {

void Sleep(int milliseconds) {
  std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

class InterruptWatchDeathTest : public testing::Test {
 protected:
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(InterruptWatchDeathTest, EndsWorkBeyondItsTimeLimit) {
  EXPECT_EXIT(
      {
        const InterruptWatch watch(.1);
        Sleep(60000);
        std::_Exit(7);
      },
      testing::ExitedWithCode(4), "the time limit of --limits is exceeded");
}

// Work that does not poll the stop flag is ended from outside.
TEST_F(InterruptWatchDeathTest, EndsInterruptedWorkWithTheStatusOfTheSignal) {
  EXPECT_EXIT(
      {
        WatchSignals();
        const InterruptWatch watch(std::nullopt);
        std::raise(SIGTERM);
        Sleep(60000);
        std::_Exit(7);
      },
      testing::ExitedWithCode(128 + SIGTERM), "interrupted before anything was rendered");
}

// The picture before has taken longer than the limit. The next one still has the whole of it.
TEST_F(InterruptWatchDeathTest, GivesTheNextPictureTheWholeTime) {
  EXPECT_EXIT(
      {
        InterruptWatch watch(.4);
        watch.MustFinish() = true;
        Sleep(500);
        watch.Restart();
        Sleep(150);
        std::_Exit(7);
      },
      testing::ExitedWithCode(7), "");
  EXPECT_EXIT(
      {
        InterruptWatch watch(.1);
        watch.MustFinish() = true;
        watch.Restart();
        Sleep(60000);
        std::_Exit(7);
      },
      testing::ExitedWithCode(4), "the time limit");
}

}  // namespace
}  // namespace exphoton::cli
