// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/photons/photon_parts.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/app/shards/part_set.h"
#include "core/base/error.h"
#include "core/files/state_file.h"

namespace exphoton::cli {

namespace fs = std::filesystem;

std::string PhotonPartPath(const std::string& folder, const Shard& shard) {
  return (fs::path(folder) / ("photons-" + std::to_string(shard.index) + "-of-" +
                              std::to_string(shard.count) + ".state"))
      .string();
}

PhotonParts::PhotonParts(const std::string& folder) : folder_(folder) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    Shard shard;
    const std::string name = it->path().filename().string();
    if (std::sscanf(name.c_str(), "photons-%d-of-%d.state", &shard.index, &shard.count) != 2 ||
        fs::path(PhotonPartPath("", shard)).filename() != name || shard.index < 1 ||
        shard.index > shard.count || shard.count > Shard::kMaxCount)
      continue;
    if (count_ != 0 && count_ != shard.count)
      throw Error(ExitStatus::File,
                  "\"" + folder + "\" has shares of " + std::to_string(count_) + " and of " +
                      std::to_string(shard.count) + " in all",
                  {}, "keep shares of one division in one folder");
    count_ = shard.count;
    try {
      StateFile(it->path().string(), StateUse::Photons);
      paths_.push_back(it->path().string());
      found_.push_back(shard.index);
    } catch (const Error& problem) {
      if (damage_.empty()) damage_ = problem.what();
    }
  }
  if (error)
    throw Error(ExitStatus::File, "cannot read the folder \"" + folder + "\": " + error.message());
  if (count_ == 0)
    throw Error(ExitStatus::File, "there are no shares of photons in \"" + folder + '"', {},
                "exphoton photons SCENE --shard I/N -o DIR writes them");
  std::ranges::sort(paths_);
}

std::vector<int> PhotonParts::Missing() const {
  std::vector<int> missing;
  for (int index = 1; index <= count_; ++index)
    if (std::ranges::find(found_, index) == found_.end()) missing.push_back(index);
  return missing;
}

void PhotonParts::CheckComplete() const {
  const std::vector<int> missing = Missing();
  if (missing.empty()) return;
  throw Error(ExitStatus::File,
              MissingText(missing, count_, "share") + " in \"" + folder_ + '"' +
                  (damage_.empty() ? "" : "; " + damage_),
              {},
              std::string("--incomplete shoots what ") + (missing.size() == 1 ? "it" : "they") +
                  " would have");
}

}  // namespace exphoton::cli
