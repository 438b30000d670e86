// SPDX-License-Identifier: BSD-2-Clause
// Floating-point traps, in builds with EXPHOTON_TRAPS: an invalid operation, a division by zero or
// an overflow ends the program where it happens, with status 5. Other builds pay nothing.
#pragma once

namespace exphoton {

#ifdef EXPHOTON_TRAPS

// For the calling thread; those that it starts inherit it.
void ArmFloatingPointTraps();

// Off while this lives: libraries raise these flags on purpose.
class UntrappedLibraryCall {
 public:
  UntrappedLibraryCall();
  ~UntrappedLibraryCall();
  UntrappedLibraryCall(const UntrappedLibraryCall&) = delete;
  UntrappedLibraryCall& operator=(const UntrappedLibraryCall&) = delete;

 private:
  int armed_;
};

#else

inline void ArmFloatingPointTraps() {}

class UntrappedLibraryCall {
 public:
  UntrappedLibraryCall() {}  // not trivial, so that an unused one is no warning
};

#endif

}  // namespace exphoton
