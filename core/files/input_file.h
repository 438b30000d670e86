// SPDX-License-Identifier: BSD-2-Clause
// These functions open files that another file names. They accept only regular files: opening a
// device can have any effect, and opening a pipe can block for ever.
#pragma once

#include <stdexcept>
#include <string>

namespace exphoton {

// InputFileError states why a file cannot be read, without its name: "no such file", "is a
// directory".
class InputFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws InputFileError if `path` is not a regular file that can be opened.
void RequireRegularFile(const std::string& path);

// Returns an open descriptor of a regular file; the caller closes it. Throws InputFileError.
int OpenRegularFile(const std::string& path);

}  // namespace exphoton
