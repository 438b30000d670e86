// SPDX-License-Identifier: BSD-2-Clause
// ThreadPool: runs numbered pieces of work on a fixed number of threads. What a piece computes must
// depend on its number only, never on the thread or the order. No global pool: a render owns one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace exphoton {

class ThreadPool {
 public:
  // count 0: as many as there are cores. Fewer are used, as Count says, where the system
  // gives no more.
  explicit ThreadPool(int count);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int Count() const;  // workers, the calling thread among them; >= 1

  // Calls work(index, worker) for every index in [0, count); worker in [0, Count()) names the
  // thread, for per-thread storage. Returns when all are done. An exception stops further pieces
  // and is thrown again here; of several, that of the lowest index. A call from within work throws
  // std::logic_error.
  void For(std::int64_t count, const std::function<void(std::int64_t index, int worker)>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exphoton
