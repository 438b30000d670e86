// SPDX-License-Identifier: BSD-2-Clause
// The traps use glibc's feenableexcept. The signal handler only writes the exception and a
// backtrace, then ends the process.
#include "core/base/fp_traps.h"

#ifdef EXPHOTON_TRAPS

#include <execinfo.h>
#include <fenv.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

namespace exphoton {
namespace {

constexpr int kTraps = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;

void Say(const char* text) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
}

void OnTrap(int, siginfo_t* info, void*) {
  const int code = info->si_code;
  Say("exphoton: error: floating-point trap: ");
  Say(code == FPE_FLTDIV   ? "division by zero"
      : code == FPE_FLTOVF ? "overflow"
      : code == FPE_FLTINV ? "invalid operation"
                           : "other");
  Say("\n");
  void* frames[32];
  backtrace_symbols_fd(frames, backtrace(frames, 32), STDERR_FILENO);
  _exit(5);
}

// Arms the traps when the core library is loaded, before any thread starts.
[[maybe_unused]] const bool isArmed = [] {
  void* frame[1];
  backtrace(frame, 1);  // the first call loads a library, which a handler must not do
  struct sigaction action {};
  action.sa_sigaction = OnTrap;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGFPE, &action, nullptr);
  ArmFloatingPointTraps();
  return true;
}();

}  // namespace

void ArmFloatingPointTraps() {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(kTraps);
}

UntrappedLibraryCall::UntrappedLibraryCall() : armed_(fedisableexcept(FE_ALL_EXCEPT)) {}

UntrappedLibraryCall::~UntrappedLibraryCall() {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(armed_);
}

}  // namespace exphoton

#endif
