// SPDX-License-Identifier: BSD-2-Clause
// Guarded turns an exception into a message on standard error and an exit status.
#pragma once

namespace exphoton::cli {

// Implements Guarded for a function pointer: calls `work` with `context`.
int GuardedCall(void (*work)(const void* context), const void* context);

// Runs `work` and returns 0, or reports its exception and returns the matching exit status.
// Allocates no memory before the exception handler is in place.
template <class Work>
int Guarded(const Work& work) {
  return GuardedCall([](const void* context) { (*static_cast<const Work*>(context))(); }, &work);
}

}  // namespace exphoton::cli
