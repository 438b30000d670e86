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
  bool isWritten = false;  // false: read
  // Program, scene and files. The integrator adds the seed and its settings.
  PhotonIdentity identity;
};

}  // namespace exphoton
