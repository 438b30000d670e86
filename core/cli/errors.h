// SPDX-License-Identifier: BSD-2-Clause
// From an exception to a message on standard error and an exit status.
#pragma once

#include <functional>

namespace exphoton::cli {

// Runs `work` and returns 0, or prints what it threw and returns the status that it leads to.
int Guarded(const std::function<void()>& work);

}  // namespace exphoton::cli
