// SPDX-License-Identifier: BSD-2-Clause
// These tests check ThreadPool: every piece of work runs once, exceptions stop the work, and the
// pool works with fewer threads than requested.
#include "core/base/parallel.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

namespace exphoton {
namespace {

TEST(ThreadPool, RunsEveryPieceOnce) {
  for (const int threads : {1, 2, 7, 64}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.Count(), threads);
    std::vector<std::atomic<int>> runs(1000);
    pool.For(1000, [&](std::int64_t index, int worker) {
      EXPECT_GE(worker, 0);
      EXPECT_LT(worker, pool.Count());
      ++runs[std::size_t(index)];
    });
    for (const auto& count : runs) EXPECT_EQ(count, 1);
  }
}

TEST(ThreadPool, AWorkersNumberIsNeverInUseTwice) {
  ThreadPool pool(4);
  std::vector<std::atomic<int>> users(4);
  pool.For(2000, [&](std::int64_t, int worker) {
    EXPECT_EQ(users[std::size_t(worker)]++, 0);
    --users[std::size_t(worker)];
  });
}

TEST(ThreadPool, CanBeUsedAgainAndWithNothingToDo) {
  ThreadPool pool(3);
  std::atomic<int> sum{0};
  for (int i = 0; i < 500; ++i) pool.For(i % 5, [&](std::int64_t, int) { ++sum; });
  EXPECT_EQ(sum, 1000);
}

TEST(ThreadPool, ZeroMeansEveryCore) { EXPECT_GE(ThreadPool(0).Count(), 1); }

TEST(ThreadPool, ThrowsTheExceptionOfTheLowestPieceAndStops) {
  ThreadPool pool(4);
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::atomic<int> runs{0};
    try {
      pool.For(1000000, [&](std::int64_t index, int) {
        ++runs;
        if (index >= 40) throw std::runtime_error(std::to_string(index));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "40");
    }
    EXPECT_LT(runs, 1000000);
  }
  std::atomic<int> runs{0};
  pool.For(10, [&](std::int64_t, int) { ++runs; });
  EXPECT_EQ(runs, 10) << "the pool is whole again after an exception";
}

TEST(ThreadPool, RefusesToBeCalledFromWithin) {
  ThreadPool pool(2);
  EXPECT_THROW(pool.For(2, [&](std::int64_t, int) { pool.For(1, [](std::int64_t, int) {}); }),
               std::logic_error);
}

// The test runs in a child process whose process limit permits no new thread. The limit does not
// apply to root. For root, a memory limit leaves no room for a thread's stack.
TEST(ThreadPool, MakesDoWithFewerThreads) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer's own memory does not fit under the limit";
#endif
  const pid_t child = fork();
  if (child == 0) {
    rlimit limit{1, 1};
    setrlimit(RLIMIT_NPROC, &limit);
    if (geteuid() == 0) {
      limit = {64 << 20, 64 << 20};
      setrlimit(RLIMIT_AS, &limit);
    }
    int sum = 0;
    ThreadPool pool(100);
    pool.For(10, [&](std::int64_t, int worker) { sum += worker == 0; });
    _exit(pool.Count() < 100 ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace exphoton
