// SPDX-License-Identifier: BSD-2-Clause
// PartSet finds the parts of a picture in folders, verifies them and compares them with each other.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/app/identity/state_identity.h"
#include "core/app/shards/part_record.h"
#include "core/base/error.h"
#include "core/render/shards/shard_sections.h"

namespace exphoton::cli {

class PartSet {
 public:
  // `paths` are folders, whose files part-*.state are read, and files. Throws Error(File) for a
  // path that cannot be read. Errors of single parts are collected.
  explicit PartSet(const std::vector<std::string>& paths);

  // Damaged and unreadable parts, parts of other pictures, and duplicates that differ.
  const std::vector<Error>& Problems() const { return problems_; }
  // Returns the number of parts of the picture; 0 if no file and no file name states it.
  int Count() const { return count_; }
  std::vector<int> Missing(int count) const;  // indices of the parts that are not there, sorted
  bool IsEmpty() const { return parts_.empty(); }

  const ShardLayout& Layout() const { return layout_; }      // of the first part
  const PartRecord& Record() const { return record_; }       // of the first part
  std::vector<const StateFile*> Files() const;               // by index
  std::vector<std::string> Paths() const { return paths_; }  // of all files, also unusable ones
  std::vector<std::string> Messages() const;                 // of all parts, each once

 private:
  void AddFile(const std::string& path);
  void Take(const std::string& path, std::unique_ptr<StateFile> file);

  std::vector<std::string> paths_;
  std::vector<Error> problems_;
  std::map<int, std::unique_ptr<StateFile>> parts_;
  std::optional<StateIdentity> identity_;  // of the first part
  std::string first_;                      // its path
  ShardLayout layout_;
  PartRecord record_;
  std::vector<std::string> messages_;
  int count_ = 0;
};

// Returns the files part-*.state of a folder, sorted, or the path itself if it is no folder. Throws
// Error(File) if there is nothing at the path.
std::vector<std::string> PartFilesAt(const std::string& path);

// Returns "3,7-9" for 3, 7, 8, 9, the form that the option --array of Slurm takes.
std::string IndexRanges(const std::vector<int>& indices);
// Returns "part 2 of the 3 parts is missing" for the noun "part". `indices` is not empty.
std::string MissingText(const std::vector<int>& indices, int count, const std::string& noun);

}  // namespace exphoton::cli
