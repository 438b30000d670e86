// SPDX-License-Identifier: BSD-2-Clause
// LoadGuard: while one lives, an exception that leaves a constructor of the library that is being
// loaded ends the program with a message and status 2. The system's loader cannot be unwound, so
// such an exception cannot be caught; without a guard it aborts the program.
#pragma once

#include <exception>
#include <string>

namespace exphoton {

class LoadGuard {
 public:
  explicit LoadGuard(std::string path);  // of the library, for the message
  ~LoadGuard();
  LoadGuard(const LoadGuard&) = delete;
  LoadGuard& operator=(const LoadGuard&) = delete;

 private:
  std::string path_;
  std::terminate_handler before_;
};

}  // namespace exphoton
