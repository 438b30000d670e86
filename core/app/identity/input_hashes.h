// SPDX-License-Identifier: BSD-2-Clause
// HashesOfInputs describes the files that a scene names, such as meshes and textures, so that a
// later run can notice that one of them has changed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/parser/render_setup.h"

namespace exphoton::cli {

struct InputHash {
  std::string name;
  std::uint64_t hash = 0;  // of the scene's directives, or of a file's bytes; 0: not readable
};

// Reads all files but the scene files, whose directives have hashes of their own.
std::vector<InputHash> HashesOfInputs(const RenderSetup& setup);

}  // namespace exphoton::cli
