// SPDX-License-Identifier: BSD-2-Clause
// LoadGuard handles exceptions in constructors of a library that is being loaded. The exception
// cannot be caught, because the system's loader cannot be unwound. While a guard exists, such an
// exception ends the program with a message and status 2; without a guard it aborts the program.
#pragma once

#include <exception>
#include <string>

namespace exphoton {

class LoadGuard {
 public:
  explicit LoadGuard(std::string path);  // path of the library, for the message
  ~LoadGuard();
  LoadGuard(const LoadGuard&) = delete;
  LoadGuard& operator=(const LoadGuard&) = delete;

 private:
  std::string path_;
  std::terminate_handler before_;
};

}  // namespace exphoton
