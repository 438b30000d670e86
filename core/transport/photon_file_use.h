// SPDX-License-Identifier: BSD-2-Clause
// PhotonFileUse names a file that photons are written to once they are shot, or that they are read
// from instead of being shot. Photons depend on the scene, the seed and some settings; the file
// states all of them, so that photons are never used where others would have been shot.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace exphoton {

// Names and values of what photons depend on: {"--seed", "7"}.
using PhotonIdentity = std::vector<std::pair<std::string, std::string>>;

struct PhotonFileUse {
  std::string path;
  bool isWritten = false;  // Preprocess writes and throws PhotonsWritten; false: it reads
  // With shardCount > 0, only the share shardIndex (1 to shardCount) of the photons is shot and
  // written.
  int shardIndex = 0, shardCount = 0;
  std::vector<std::string> parts;  // with isWritten: files of shares that are taken over
  // Program, scene and files. The integrator adds the seed and its settings.
  PhotonIdentity identity;
};

// Thrown once the photons are in their file: there is nothing to render.
struct PhotonsWritten {};

}  // namespace exphoton
