// SPDX-License-Identifier: BSD-2-Clause
// Signal handlers call only async-signal-safe functions (POSIX). The flags are static because
// signals belong to the process.
#include "core/app/process/signals.h"

#include <sys/wait.h>

#include <cerrno>
#include <csignal>

#include "core/files/temporary_file.h"

namespace exphoton::cli {
namespace {

std::atomic<bool> stop{false};
std::atomic<int> number{0};
std::atomic<pid_t> workingChild{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void End(int signal) {
  const pid_t child = workingChild;
  if (child > 0) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  RemoveTemporaryFiles();
  std::signal(signal, SIG_DFL);
  raise(signal);  // delivered when this handler returns, since the signal is blocked here
}

void Stop(int signal) {
  const int reason = errno;
  if (stop.exchange(true)) return End(signal);
  number = signal;
  errno = reason;
}

bool EndsAProcess(int signal) {
  switch (signal) {
    case SIGKILL:  // cannot be caught, like SIGSTOP
    case SIGSTOP:
    case SIGTSTP:
    case SIGTTIN:
    case SIGTTOU:
    case SIGCHLD:  // ignored by default, like the following ones
    case SIGCONT:
    case SIGURG:
    case SIGWINCH:
      return false;
    default:
      return true;
  }
}

bool AsksToStop(int signal) { return signal == SIGINT || signal == SIGTERM || signal == SIGHUP; }

// Gives handlers their own stack, because an overflowed stack has no room for a handler.
void UseOwnStack() {
  static char room[1 << 16];
  stack_t stack{};
  stack.ss_sp = room;
  stack.ss_size = sizeof room;
  sigaltstack(&stack, nullptr);
}

}  // namespace

void WatchSignals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  UseOwnStack();
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    struct sigaction before {};
    if (!EndsAProcess(signal) || sigaction(signal, nullptr, &before) != 0) continue;
    // Keep handlers of others, such as sanitizers and floating-point traps, and ignored signals.
    if ((before.sa_flags & SA_SIGINFO) || before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = AsksToStop(signal) ? Stop : End;
    action.sa_flags = SA_ONSTACK;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

void RestoreSignals() {
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) != 0 || !EndsAProcess(signal)) continue;
    const bool isOurs = signal == SIGPIPE || signal == SIGXFSZ || now.sa_handler != SIG_IGN;
    if (isOurs) std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

const std::atomic<bool>& StopFlag() { return stop; }
int SignalNumber() { return number; }
void SetWorkingChild(pid_t child) { workingChild = child; }

}  // namespace exphoton::cli
