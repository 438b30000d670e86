// SPDX-License-Identifier: BSD-2-Clause
// Interrupts: the first SIGINT or SIGTERM asks the render to stop, a second one ends the process and
// leaves no unfinished file.
#pragma once

#include <atomic>

namespace exphoton::cli {

// Takes SIGINT and SIGTERM, ignores SIGPIPE and SIGXFSZ (writes fail with an error instead).
// Once a process; the flag is the process's, like the signals.
void WatchSignals();

const std::atomic<bool>& StopFlag();
int SignalNumber();  // 0: none came

}  // namespace exphoton::cli
