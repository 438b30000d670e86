// SPDX-License-Identifier: BSD-2-Clause
// The handler only sets flags; they are static because signals belong to the process.
#include "core/cli/signals.h"

#include <csignal>

namespace exphoton::cli {
namespace {

std::atomic<bool> stop{false};
std::atomic<int> number{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void Handle(int signal) {
  number = signal;
  stop = true;
}

}  // namespace

void WatchSignals() {
  struct sigaction action {};
  action.sa_handler = Handle;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
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
