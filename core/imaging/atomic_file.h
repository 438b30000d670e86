// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile: a file that appears under its name only when it is complete. Until then it is
// "NAME.PID.partial" in the same folder; without Commit that is removed and an older NAME stays.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace exphoton {

// Every member throws Error(File) that names the target and the system's reason.
class AtomicFile {
 public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::FILE* Stream() { return stream_; }
  void Write(const void* data, std::size_t size);
  std::uint64_t Tell();
  void Seek(std::uint64_t position);

  // Brings everything to the disk, then gives the file its name.
  void Commit();

 private:
  [[noreturn]] void Fail(const std::string& what);
  void RemovePartial();

  std::string target_, partial_;
  std::FILE* stream_ = nullptr;
  int slot_ = -1;    // where RemovePartialFiles finds it
  int failure_ = 0;  // errno of the first failure: a caller that swallowed it cannot Commit
};

// Removes the unfinished files of this process, for a handler of a signal that ends it: calls only
// what is safe there. Up to a few files, whose names are not absurdly long.
void RemovePartialFiles();

}  // namespace exphoton
