// SPDX-License-Identifier: BSD-2-Clause
// TemporaryFile is a new file under a random name. Unless it is renamed, it is removed with the
// object, or when a signal ends the process. Temporary files of other processes are never touched.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <string>

namespace exphoton {

// SignalBlock blocks all signals in the calling thread during its lifetime.
class SignalBlock {
 public:
  SignalBlock();
  ~SignalBlock();
  SignalBlock(const SignalBlock&) = delete;
  SignalBlock& operator=(const SignalBlock&) = delete;

 private:
  sigset_t before_;
};

class TemporaryFile {
 public:
  // Opens "NAME.<random>.partial" for writing in an open folder, which must outlive this object. A
  // NAME that is too long is shortened. Throws std::system_error.
  TemporaryFile(int folder, const std::string& name, mode_t mode);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int Descriptor() const { return descriptor_; }  // the caller closes it

  // Renames the file within its folder, atomically. On failure it returns false and sets errno.
  bool Rename(const std::string& name);
  void Remove();

 private:
  int folder_, descriptor_ = -1;
  std::string name_;
  int slot_ = -1;  // index in the table that RemoveTemporaryFiles reads
};

// ScratchFolderGuard empties a folder when a signal ends the process. The folder must belong to
// this process alone. The folder itself and its subfolders stay.
class ScratchFolderGuard {
 public:
  explicit ScratchFolderGuard(int folder);
  ~ScratchFolderGuard();
  ScratchFolderGuard(const ScratchFolderGuard&) = delete;
  ScratchFolderGuard& operator=(const ScratchFolderGuard&) = delete;

 private:
  int slot_;
};

// Removes the temporary files of this process. It is async-signal-safe, for a handler of a signal
// that ends the process. No further temporary file is made afterwards.
void RemoveTemporaryFiles();

// Returns 13 random characters from a-z and 2-7.
std::string RandomName();

}  // namespace exphoton
