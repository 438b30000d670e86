// SPDX-License-Identifier: BSD-2-Clause
// RunSelf runs this program in a child process and measures its time and memory (POSIX).
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace exphoton::cli {

struct ChildResult {
  int status = 0;               // exit status; 128 + n if signal n ended the child
  bool wasInterrupted = false;  // `stop` was set and the child was killed
  double wallSeconds = 0, cpuSeconds = 0;
  double peakMemory = 0;  // bytes
  std::string messages;   // the child's standard output and error
};

// Returns the warnings among the messages of a render, each with its source line and hint.
std::vector<std::string> WarningsIn(const std::string& messages);

std::string OwnProgram();  // path of the running program; throws Error(Internal)

// Runs this program and waits for its end. Kills it if `stop` is set or this process ends. Its
// standard input is empty; its standard output and error go to `logFile`, which is read and
// removed. Throws Error(Resource).
ChildResult RunSelf(const std::vector<std::string>& arguments, const std::string& logFile,
                    const std::atomic<bool>& stop);

}  // namespace exphoton::cli
