// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile writes a file that appears under its name only when it is complete. Until then it has
// a random name in the same folder. Without Commit this file is removed, and an older file stays.
// The mode, owner and access control list of an older file are kept where the system permits it.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "core/files/open_file.h"
#include "core/files/temporary_file.h"

namespace exphoton {

// Errors throw Error(ExitStatus::File) with the target and the system's reason. Lack of memory
// throws std::bad_alloc.
class AtomicFile {
 public:
  // Follows symbolic links. The file at their end need not exist.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::FILE* Stream() { return stream_; }
  void Write(const void* data, std::size_t size);
  std::uint64_t Tell();
  void Seek(std::uint64_t position);

  // Syncs the data to the disk, gives the file its name, then syncs the folder.
  void Commit();

 private:
  [[noreturn]] void Fail(const std::string& what);
  void KeepAttributes();

  std::string path_, name_;  // path as given; name within the folder
  std::unique_ptr<Descriptor> folder_;
  std::unique_ptr<TemporaryFile> file_;
  std::FILE* stream_ = nullptr;
  mode_t mode_ = 0;  // of the older file; 0 if there was none
  int failure_ = 0;  // errno of the first failure, after which Commit fails too
};

}  // namespace exphoton
