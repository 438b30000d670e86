// SPDX-License-Identifier: BSD-2-Clause
// OpenRegularFile checks the file type before it opens the file, and once more on the open
// descriptor.
#include "core/files/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>

namespace exphoton {
namespace {

[[noreturn]] void Fail() {
  if (errno == ENOMEM) throw std::bad_alloc();
  throw InputFileError(errno == ENOENT ? "no such file" : std::strerror(errno));
}

void RequireRegular(const struct stat& status) {
  if (S_ISREG(status.st_mode)) return;
  throw InputFileError(S_ISDIR(status.st_mode) ? "is a directory" : "is not a regular file");
}

}  // namespace

int OpenRegularFile(const std::string& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0) Fail();
  RequireRegular(status);
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (file < 0) Fail();
  try {
    if (fstat(file, &status) != 0) Fail();
    RequireRegular(status);
  } catch (...) {
    close(file);
    throw;
  }
  return file;
}

void RequireRegularFile(const std::string& path) { close(OpenRegularFile(path)); }

}  // namespace exphoton
