// SPDX-License-Identifier: BSD-2-Clause
// PartSet reads each file once to verify it. Sections are read again for the merge.
#include "core/app/shards/part_set.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/render/state/checkpoints.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

// Returns N for a file "part-I-of-N.state"; 0 for other names.
int CountInName(const std::string& path) {
  int index = 0, count = 0;
  const std::string name = fs::path(path).filename().string();
  if (std::sscanf(name.c_str(), "part-%9d-of-%9d.state", &index, &count) != 2) return 0;
  return count >= 1 && count <= Shard::kMaxCount ? count : 0;
}

// Times and messages differ between two renders of the same part.
bool IsComparable(const std::string& section) {
  return section != kPartSection && !section.ends_with(" statistics") &&
         section.find(" times of tile ") == std::string::npos;
}

bool HaveSameSums(const StateFile& a, const StateFile& b) {
  const std::vector<std::string> names = a.Names();
  if (names != b.Names()) return false;
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return !IsComparable(name) || a.Digest(name) == b.Digest(name);
  });
}

std::string InQuotes(const std::string& text) { return '"' + text + '"'; }

}  // namespace

PartSet::PartSet(const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    for (const std::string& file : PartFilesAt(path)) AddFile(file);
  if (count_ == 0)
    for (const std::string& path : paths_) count_ = std::max(count_, CountInName(path));
}

void PartSet::AddFile(const std::string& path) {
  paths_.push_back(path);
  try {
    auto file = std::make_unique<StateFile>(path, StateUse::Part);
    if (!file->Has(kShardSection))
      throw Error(ExitStatus::File,
                  "cannot use the part " + InQuotes(path) +
                      ": it is the state of a stopped render, not a part",
                  {}, "the command of that render with --resume continues it");
    Take(path, std::move(file));
  } catch (const Error& error) {
    problems_.push_back(error);
  }
}

void PartSet::Take(const std::string& path, std::unique_ptr<StateFile> file) {
  const StateIdentity identity = StateIdentity::Of(*file);
  ShardLayout layout;
  PartRecord record;
  LoadSection(kShardSection, &layout, *file);
  LoadSection(kPartSection, &record, *file);
  file->Close();
  const char* const hint = "merge the parts of one picture only";
  if (identity.Program() != VersionText())
    throw Error(ExitStatus::CommandLine,
                "cannot use the part " + InQuotes(path) + ": it is by " + identity.Program() +
                    ", this is " + VersionText(),
                {}, "use the same version of the program for all parts and for the merge");
  if (!identity_) {
    identity_ = identity;
    first_ = path;
    layout_ = layout;
    record_ = record;
    count_ = layout.shard.count;
  }
  const std::string differences = identity_->Differences(identity);
  if (!differences.empty())
    throw Error(ExitStatus::CommandLine,
                InQuotes(path) + " (there) and " + InQuotes(first_) +
                    " (here) are parts of different pictures: " + differences,
                {}, hint);
  if (layout.shard.count != count_)
    throw Error(ExitStatus::CommandLine,
                InQuotes(path) + " is one of " + std::to_string(layout.shard.count) +
                    " parts, but " + InQuotes(first_) + " is one of " + std::to_string(count_),
                {}, "divide the picture into the same number of shards every time");
  const auto [known, isNew] = parts_.try_emplace(layout.shard.index, nullptr);
  if (!isNew && !HaveSameSums(*known->second, *file))
    throw Error(ExitStatus::File,
                InQuotes(path) + " and " + InQuotes(known->second->Path()) +
                    " are the same part with different contents",
                {}, "remove both and render the part again");
  if (isNew) known->second = std::move(file);
  for (const std::string& message : record.messages)
    if (std::find(messages_.begin(), messages_.end(), message) == messages_.end())
      messages_.push_back(message);
}

std::vector<int> PartSet::Missing(int count) const {
  std::vector<int> missing;
  for (int index = 1; index <= count; ++index)
    if (!parts_.contains(index)) missing.push_back(index);
  return missing;
}

std::vector<const StateFile*> PartSet::Files() const {
  std::vector<const StateFile*> files;
  for (const auto& [index, file] : parts_) files.push_back(file.get());
  return files;
}

std::vector<std::string> PartSet::Messages() const { return messages_; }

std::vector<std::string> PartFilesAt(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw Error(ExitStatus::File, "cannot read \"" + path + "\": no such file or folder");
  if (!fs::is_directory(status)) return {path};
  std::vector<std::string> files;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with("part-") && name.ends_with(".state")) files.push_back(entry->path());
  }
  if (error)
    throw Error(ExitStatus::File, "cannot read the folder \"" + path + "\": " + error.message(), {},
                "merge reads the parts in this folder, so you need the permission to list it");
  std::sort(files.begin(), files.end());
  return files;
}

std::string IndexRanges(const std::vector<int>& indices) {
  std::string text;
  for (std::size_t begin = 0; begin < indices.size();) {
    std::size_t end = begin + 1;
    while (end < indices.size() && indices[end] == indices[end - 1] + 1) ++end;
    text += (text.empty() ? "" : ",") + std::to_string(indices[begin]);
    if (end > begin + 1) text += "-" + std::to_string(indices[end - 1]);
    begin = end;
  }
  return text;
}

std::string MissingText(const std::vector<int>& indices, int count, const std::string& noun) {
  if (count == 1) return "the only " + noun + " is missing";
  const bool isOne = indices.size() == 1;
  return noun + (isOne ? " " : "s ") + IndexRanges(indices) + " of the " + std::to_string(count) +
         " " + noun + "s " + (isOne ? "is" : "are") + " missing";
}

}  // namespace exphoton::cli
