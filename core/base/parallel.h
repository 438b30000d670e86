// SPDX-License-Identifier: BSD-2-Clause
// ThreadPool runs numbered work items on a fixed number of threads. The result of an item must
// depend on its number only, never on the thread or the order. There is no global pool: each render
// owns one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

namespace exphoton {

class ThreadPool {
 public:
  // count 0 means one thread per core. If the system cannot start that many, the pool uses fewer
  // threads; Count returns the actual number.
  explicit ThreadPool(int count);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int Count() const;  // number of workers, including the calling thread; >= 1

  // Calls work(index, worker) for every index in [0, count) and returns when all calls are done.
  // `worker` in [0, Count()) identifies the thread, for per-thread storage. An exception stops
  // further items and is rethrown here; if several items throw, it is the exception of the lowest
  // index. A nested call from within work throws std::logic_error.
  void For(std::int64_t count, const std::function<void(std::int64_t index, int worker)>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace exphoton
