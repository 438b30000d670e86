// SPDX-License-Identifier: BSD-2-Clause
// EditableState changes a file of StateWriter as the bytes of a fuzzer say, and writes it again
// with a checksum that fits. A fuzzer that changed the bytes of the file itself would never pass
// the checksum.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/files/state_file.h"
#include "tests/fuzz/input.h"

namespace exphoton::fuzz {

// TemporaryFolder is an empty folder in memory. Its destructor removes it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string File(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

class EditableState {
 public:
  explicit EditableState(const std::string& path);

  // Changes bytes, shortens, lengthens or drops sections, until the input ends.
  void Edit(Input input);
  void Write(const std::string& path) const;

 private:
  std::vector<std::pair<std::string, std::string>> sections_;  // names and bytes
};

// While it lives, standard output and standard error go nowhere.
class Silence {
 public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int saved_[2];
};

}  // namespace exphoton::fuzz
