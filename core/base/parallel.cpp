// SPDX-License-Identifier: BSD-2-Clause
// The workers of ThreadPool sleep between calls of For. During a call they take the next index from
// one atomic counter.
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include "core/base/fp_traps.h"

namespace exphoton {

struct ThreadPool::State {
  using Work = std::function<void(std::int64_t, int)>;

  std::vector<std::thread> threads;  // the calling thread is worker 0 and not among them
  std::mutex mutex;
  std::condition_variable start, finished;
  // `mutex` guards the members up to failedIndex.
  std::uint64_t generation = 0;  // counts the calls of For
  int busy = 0;
  bool isEnding = false, isRunning = false;
  std::exception_ptr failure;
  std::int64_t failedIndex = std::numeric_limits<std::int64_t>::max();

  // For sets these members before it wakes the workers.
  const Work* work = nullptr;
  std::int64_t count = 0;
  std::atomic<std::int64_t> next{0};
  std::atomic<bool> isStopped{false};

  // Indices are taken in increasing order, and every index taken is run. If several items would
  // throw, the one with the lowest index therefore always runs, and its exception is kept. The
  // reported error does not depend on thread scheduling.
  void RunPieces(int worker) {
    while (!isStopped.load(std::memory_order_relaxed)) {
      const std::int64_t index = next.fetch_add(1, std::memory_order_relaxed);
      if (index >= count) return;
      try {
        (*work)(index, worker);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (index < failedIndex) failedIndex = index, failure = std::current_exception();
        isStopped = true;
      }
    }
  }

  void Sleep(int worker) {
    ArmFloatingPointTraps();
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    while (true) {
      start.wait(lock, [&] { return isEnding || generation != seen; });
      if (isEnding) return;
      seen = generation;
      lock.unlock();
      RunPieces(worker);
      lock.lock();
      if (--busy == 0) finished.notify_one();
    }
  }
};

ThreadPool::ThreadPool(int count) : state_(std::make_unique<State>()) {
  if (count <= 0) count = int(std::max(1u, std::thread::hardware_concurrency()));
  State* state = state_.get();
  try {
    for (int worker = 1; worker < count; ++worker) {
      state->threads.emplace_back([state, worker] { state->Sleep(worker); });
    }
  } catch (const std::system_error&) {
    // The system refuses more threads. The pool works with the threads started so far.
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->isEnding = true;
  }
  state_->start.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

int ThreadPool::Count() const { return int(state_->threads.size()) + 1; }

void ThreadPool::For(std::int64_t count,
                     const std::function<void(std::int64_t index, int worker)>& work) {
  if (count <= 0) return;
  State& state = *state_;
  {
    const std::lock_guard lock(state.mutex);
    if (state.isRunning) throw std::logic_error("ThreadPool::For called from within its work");
    state.isRunning = true;
    state.work = &work;
    state.count = count;
    state.next = 0;
    state.isStopped = false;
    state.failure = nullptr;
    state.failedIndex = std::numeric_limits<std::int64_t>::max();
    state.busy = int(state.threads.size());
    ++state.generation;
  }
  state.start.notify_all();
  state.RunPieces(0);
  std::exception_ptr failure;
  {
    std::unique_lock lock(state.mutex);
    state.finished.wait(lock, [&] { return state.busy == 0; });
    state.isRunning = false;
    std::swap(failure, state.failure);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace exphoton
