// SPDX-License-Identifier: BSD-2-Clause
// TemporaryFile: a new file under a random name, which vanishes with the object, or with the
// process when a signal ends it, unless it is renamed. Temporaries of other processes are never
// touched.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <string>

namespace exphoton {

// Keeps every signal from the calling thread while it lives.
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
  // Opens "NAME.<random>.partial" (NAME is shortened where that is too long) for writing in an open
  // folder, which must outlive this. Throws std::system_error.
  TemporaryFile(int folder, const std::string& name, mode_t mode);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int Descriptor() const { return descriptor_; }  // for the caller to close

  // Gives the file its name, in the same folder, in one step. False: see errno.
  bool Rename(const std::string& name);
  void Remove();

 private:
  int folder_, descriptor_ = -1;
  std::string name_;
  int slot_ = -1;  // where RemoveTemporaryFiles finds it
};

// Empties a folder that belongs to this process alone when a signal ends the process. The folder
// itself stays. Subfolders stay, too.
class ScratchFolderGuard {
 public:
  explicit ScratchFolderGuard(int folder);
  ~ScratchFolderGuard();
  ScratchFolderGuard(const ScratchFolderGuard&) = delete;
  ScratchFolderGuard& operator=(const ScratchFolderGuard&) = delete;

 private:
  int slot_;
};

// Removes the temporaries of this process. Async-signal-safe: for a handler of a signal that ends
// the process. No further temporary is made afterwards.
void RemoveTemporaryFiles();

// 13 random characters of a-z and 2-7.
std::string RandomName();

}  // namespace exphoton
