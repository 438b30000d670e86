// SPDX-License-Identifier: BSD-2-Clause
// A child process as tests start it: in a folder of its own, its output in files there; what it
// left and what it used.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace exphoton {

struct ProcessResult {
  int status = -1;  // exit status; 128 + n where a signal ended it
  bool isLate = false;
  double seconds = 0, megabytes = 0;  // wall time since the wait began; peak resident set
  std::string out, err;
};

struct ProcessCommand {
  std::vector<std::string> words;
  std::string folder;                      // where it runs; gets files that TestFolder hides
  std::vector<std::string> environment{};  // added: NAME=value
  std::string input{};                     // what standard input holds
  double timeLimit = 60;                   // seconds, after which it is killed with its children
};

// Starts it as the leader of a process group, with the default answers to signals.
pid_t StartProcess(const ProcessCommand& command);
ProcessResult WaitForProcess(pid_t process, const std::string& folder, double timeLimit);
// Both.
ProcessResult RunProcess(const ProcessCommand& command);

std::string ReadFile(const std::string& path);  // "" where there is none
void WriteFile(const std::string& path, const std::string& text);

// An empty folder that is removed at the end.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  const std::string& Path() const { return path_; }
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  std::vector<std::string> Names() const;  // sorted, without what StartProcess made
  // What a process that runs here has said so far.
  std::string StandardOutput() const;
  std::string StandardError() const;

 private:
  std::string path_;
};

}  // namespace exphoton
