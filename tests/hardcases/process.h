// SPDX-License-Identifier: BSD-2-Clause
// A child process with a time limit, and what it used.
#pragma once

#include <string>
#include <vector>

namespace exphoton::hardcases {

struct Outcome {
  int status = -1;  // exit status; 128 + n where a signal ended it
  bool isLate = false;
  double seconds = 0, megabytes = 0;  // wall time; peak resident set
  std::string out, err;
};

struct Command {
  std::vector<std::string> words;
  std::vector<std::string> environment;  // added: NAME=value
  std::string folder;                    // where it runs; gets .stdout and .stderr
  double timeLimit = 60;
};

Outcome Execute(const Command& command);

std::string ReadFile(const std::string& path);
void WriteFile(const std::string& path, const std::string& text);

// An empty folder that is removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& Path() const { return path_; }
  std::string File(const std::string& name) const { return path_ + "/" + name; }
  std::vector<std::string> Names() const;  // sorted, without what Execute made

 private:
  std::string path_;
};

}  // namespace exphoton::hardcases
