// SPDX-License-Identifier: BSD-2-Clause
// Files that are read because another file names them: regular ones only. A device can do anything
// when it is opened, and a pipe makes the program wait for ever.
#pragma once

#include <stdexcept>
#include <string>

namespace exphoton {

// Why a file cannot be read, without its name: "no such file", "is a directory".
class InputFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws InputFileError where `path` is no regular file that can be opened.
void RequireRegularFile(const std::string& path);

// An open descriptor of a regular file, for the caller to close. Throws InputFileError.
int OpenRegularFile(const std::string& path);

}  // namespace exphoton
