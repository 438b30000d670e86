// SPDX-License-Identifier: BSD-2-Clause
// A run of this program in a process of its own, measured from outside. POSIX.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace exphoton::cli {

struct ChildResult {
  int status = 0;               // exit status; 128 + n where a signal ended it
  bool wasInterrupted = false;  // `stop` was set: the child was ended
  double wallSeconds = 0, cpuSeconds = 0;
  double peakMemory = 0;  // bytes
  std::string messages;   // what it said on standard error
};

std::string OwnProgram();  // the path of the running program; throws Error(Internal)

// Waits for it to end; ends it once `stop` is set, and with this process. Standard input is empty,
// standard output and error go to `logFile`, which is read and removed. Throws Error(Resource).
ChildResult RunSelf(const std::vector<std::string>& arguments, const std::string& logFile,
                    const std::atomic<bool>& stop);

}  // namespace exphoton::cli
