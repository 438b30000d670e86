// SPDX-License-Identifier: BSD-2-Clause
// Scene paths are tried in three folders.
#include "core/params/scene_path.h"

#include <algorithm>
#include <filesystem>

namespace exphoton {

namespace fs = std::filesystem;

std::vector<std::string> ScenePathCandidates(const std::string& name, const std::string& from,
                                             const std::string& mainFile) {
  if (fs::path(name).is_absolute()) return {name};
  std::vector<std::string> candidates;
  for (const fs::path& folder :
       {fs::path(from).parent_path(), fs::path(mainFile).parent_path(), fs::path()}) {
    std::string path = (folder / name).lexically_normal().string();
    if (std::find(candidates.begin(), candidates.end(), path) == candidates.end())
      candidates.push_back(std::move(path));
  }
  return candidates;
}

const std::string& MainFileOf(const SourceLocation& where) {
  const SourceLocation* location = &where;
  while (location->includedFrom) location = location->includedFrom.get();
  return location->file;
}

std::string ResolveScenePath(const std::string& name, const SourceLocation& where) {
  const std::vector<std::string> candidates =
      ScenePathCandidates(name, where.file, MainFileOf(where));
  for (const std::string& path : candidates) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path;
  }
  return candidates.front();
}

std::string TriedPathsText(const std::vector<std::string>& candidates) {
  std::string text;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i > 0) text += i + 1 == candidates.size() ? " and " : ", ";
    text += '"' + candidates[i] + '"';
  }
  return "tried " + text;
}

std::string UnreadableFileText(const std::string& path, const std::string& fault) {
  if (fault.starts_with(path + ':') && !fault.starts_with(path + ": "))  // with a line number
    return "names a file that cannot be read: " + fault;
  const std::size_t begin = fault.starts_with(path + ": ") ? path.size() + 2 : 0;
  return "names \"" + path + "\", which cannot be read: " + fault.substr(begin);
}

}  // namespace exphoton
