// SPDX-License-Identifier: BSD-2-Clause
// From an exception to a message on standard error and an exit status.
#pragma once

namespace exphoton::cli {

// As Guarded, of a function and what it works on.
int GuardedCall(void (*work)(const void* context), const void* context);

// Runs `work` and returns 0, or prints what it threw and returns the status that it leads to. Does
// not allocate before it guards.
template <class Work>
int Guarded(const Work& work) {
  return GuardedCall([](const void* context) { (*static_cast<const Work*>(context))(); }, &work);
}

}  // namespace exphoton::cli
