// SPDX-License-Identifier: BSD-2-Clause
// Signals. The first SIGINT, SIGTERM or SIGHUP asks the work to stop; a second one, and every other
// signal that ends a process and can be caught, removes what is unfinished and ends the process.
#pragma once

#include <sys/types.h>

#include <atomic>

namespace exphoton::cli {

// Once a process; the flag is the process's, like the signals. A signal that is ignored stays so
// (SIGHUP under nohup). SIGPIPE and SIGXFSZ are ignored: writes fail with an error instead.
void WatchSignals();

// In a forked child: the answers to signals that a new program should begin with.
void RestoreSignals();

const std::atomic<bool>& StopFlag();
int SignalNumber();  // 0: none came

// The process that works for this one; a signal that ends this one ends it first. 0: none.
void SetWorkingChild(pid_t child);

}  // namespace exphoton::cli
