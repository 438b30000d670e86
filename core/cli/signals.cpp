// SPDX-License-Identifier: BSD-2-Clause
// The handler only sets flags; they are static because signals belong to the process.
#include "core/cli/signals.h"

#include <csignal>

#include "core/imaging/atomic_file.h"

namespace exphoton::cli {
namespace {

std::atomic<bool> stop{false};
std::atomic<int> number{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void Handle(int signal) {
  if (!stop.exchange(true)) {
    number = signal;
    return;
  }
  RemovePartialFiles();
  std::signal(signal, SIG_DFL);
  raise(signal);  // arrives when this handler returns
}

}  // namespace

void WatchSignals() {
  struct sigaction action {};
  action.sa_handler = Handle;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // A process started in the background ignores SIGINT: leave that.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

const std::atomic<bool>& StopFlag() { return stop; }
int SignalNumber() { return number; }

}  // namespace exphoton::cli
