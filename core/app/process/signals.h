// SPDX-License-Identifier: BSD-2-Clause
// WatchSignals installs signal handlers. The first SIGINT, SIGTERM or SIGHUP sets the stop flag. A
// second one, and every other catchable signal that ends a process, removes unfinished files and
// ends the process.
#pragma once

#include <sys/types.h>

#include <atomic>

namespace exphoton::cli {

// Installs the handlers. Call it once per process. Ignored signals stay ignored (SIGHUP under
// nohup). SIGPIPE and SIGXFSZ become ignored, so that writes fail with an error instead.
void WatchSignals();

// Restores the default handlers and clears the signal mask, in a forked child before exec.
void RestoreSignals();

const std::atomic<bool>& StopFlag();
int SignalNumber();  // 0: no signal was received

// Sets the child process that a signal kills before it ends this process. 0: none.
void SetWorkingChild(pid_t child);

}  // namespace exphoton::cli
