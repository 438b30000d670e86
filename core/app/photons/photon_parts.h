// SPDX-License-Identifier: BSD-2-Clause
// PhotonParts finds the shares of photons in a folder (exphoton photons --shard, --merge).
#pragma once

#include <string>
#include <vector>

#include "core/render/shards/shard_tiles.h"

namespace exphoton::cli {

// Returns FOLDER/photons-3-of-16.state.
std::string PhotonPartPath(const std::string& folder, const Shard& shard);

class PhotonParts {
 public:
  // Reads all files photons-*.state of the folder. Throws Error(File) if there is none, or if they
  // are shares of different divisions.
  explicit PhotonParts(const std::string& folder);

  const std::vector<std::string>& Paths() const { return paths_; }  // of the undamaged files
  std::vector<int> Missing() const;  // indices of missing and damaged shares, sorted
  // Throws Error(File) that names missing and damaged shares.
  void CheckComplete() const;

 private:
  std::string folder_;
  std::vector<std::string> paths_;
  std::vector<int> found_;
  int count_ = 0;
  std::string damage_;  // of the first damaged file
};

}  // namespace exphoton::cli
