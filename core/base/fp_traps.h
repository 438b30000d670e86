// SPDX-License-Identifier: BSD-2-Clause
// Floating-point traps end the program at an invalid operation, a division by zero or an overflow,
// with exit status 5. Only builds with EXPHOTON_TRAPS have them; other builds have no cost.
#pragma once

namespace exphoton {

#ifdef EXPHOTON_TRAPS

// Arms the traps in the calling thread. Threads that it starts afterwards inherit them.
void ArmFloatingPointTraps();

// Disables the traps during its lifetime. It guards calls of libraries that raise these exceptions
// on purpose.
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
  UntrappedLibraryCall() {}  // non-trivial, so that an unused variable causes no warning
};

#endif

}  // namespace exphoton
