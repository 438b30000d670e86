// SPDX-License-Identifier: BSD-2-Clause
// RunProcess runs a child process for tests. The child runs in a given folder, where files receive
// its output. The result has its output, exit status, run time and memory.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace exphoton {

struct ProcessResult {
  int status = -1;  // exit status; 128 + n after signal n
  bool isLate = false;
  double seconds = 0, megabytes = 0;  // wall time of the wait; peak resident set
  std::string out, err;
};

struct ProcessCommand {
  std::vector<std::string> words;
  std::string folder;                      // working folder; gets files that TestFolder hides
  std::vector<std::string> environment{};  // additional variables: NAME=value
  std::string input{};                     // content of standard input
  double timeLimit = 60;                   // seconds until it is killed with its children
};

// Starts the process as the leader of a process group, with default signal handlers.
pid_t StartProcess(const ProcessCommand& command);
ProcessResult WaitForProcess(pid_t process, const std::string& folder, double timeLimit);
// Starts a process and waits for it.
ProcessResult RunProcess(const ProcessCommand& command);

std::string ReadFile(const std::string& path);  // "" if there is no such file
void WriteFile(const std::string& path, const std::string& text);

// TestFolder is an empty folder that its destructor removes.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::string& Path() const { return path_; }
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  std::vector<std::string> Names() const;  // sorted, without StartProcess's files
  // Returns the output so far of a process that runs in this folder.
  std::string StandardOutput() const;
  std::string StandardError() const;

 private:
  std::string path_;
};

}  // namespace exphoton
