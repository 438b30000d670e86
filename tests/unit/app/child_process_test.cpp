// SPDX-License-Identifier: BSD-2-Clause
// These tests run this test program as a child process.
#include "core/app/process/child_process.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace exphoton::cli {
namespace {

ChildResult RunTest(const std::string& name) {
  for (const char* variable : {"GTEST_TOTAL_SHARDS", "GTEST_SHARD_INDEX"})
    unsetenv(variable);  // no share
  const std::atomic<bool> stop = false;
  return RunSelf({"--gtest_filter=" + name, "--gtest_also_run_disabled_tests"},
                 testing::TempDir() + "exphoton_child_" + std::to_string(getpid()), stop);
}

TEST(ChildProcess, DISABLED_EndsItselfByASignal) { raise(SIGKILL); }
TEST(ChildProcess, DISABLED_Passes) {}

TEST(ChildProcess, ThatASignalEndedHasAStatusOf128AndItsNumber) {
  const ChildResult result = RunTest("ChildProcess.DISABLED_EndsItselfByASignal");
  EXPECT_EQ(result.status, 128 + SIGKILL);
  EXPECT_FALSE(result.wasInterrupted);
}

// The program alone takes some megabytes.
TEST(ChildProcess, HasItsOutputAndItsMemoryInBytes) {
  const ChildResult result = RunTest("ChildProcess.DISABLED_Passes");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.messages.find("1 test"), std::string::npos) << result.messages;
  EXPECT_GT(result.peakMemory, 1e6);
  EXPECT_LT(result.peakMemory, 1e10);
}

}  // namespace
}  // namespace exphoton::cli
