// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile: a file that appears under its name only when it is complete. Until then it has a
// random name in the same folder; without Commit that file is removed and an older one stays.
// Mode, owner and access control list of an older file are kept where the system permits it.
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

// Every member throws Error(File) that names the target and the system's reason.
class AtomicFile {
 public:
  // Links are followed to their end, which need not exist.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::FILE* Stream() { return stream_; }
  void Write(const void* data, std::size_t size);
  std::uint64_t Tell();
  void Seek(std::uint64_t position);

  // Brings everything to the disk, then gives the file its name, then brings the name to the disk.
  void Commit();

 private:
  [[noreturn]] void Fail(const std::string& what);
  void KeepAttributes();

  std::string path_, name_;  // as given; within the folder
  std::unique_ptr<Descriptor> folder_;
  std::unique_ptr<TemporaryFile> file_;
  std::FILE* stream_ = nullptr;
  mode_t mode_ = 0;  // of an older file; 0: there was none
  int failure_ = 0;  // errno of the first failure: a caller that swallowed it cannot Commit
};

}  // namespace exphoton
