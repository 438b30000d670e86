// SPDX-License-Identifier: BSD-2-Clause
// TemporaryFolder is a new folder that is removed with its files, unless they are kept.
#pragma once

#include <string>

namespace exphoton::cli {

class TemporaryFolder {
 public:
  // `purpose` is a part of the folder's name. Throws Error(File).
  explicit TemporaryFolder(const std::string& purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  void Keep() { isKept_ = true; }  // the folder is not removed

  // Returns the path of a file in the folder.
  std::string File(const std::string& name) const { return path_ + '/' + name; }

 private:
  std::string path_;
  bool isKept_ = false;
};

}  // namespace exphoton::cli
