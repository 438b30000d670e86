// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/identity/input_hashes.h"

#include "core/files/input_file.h"
#include "core/files/state_file.h"

namespace exphoton::cli {
namespace {

// Directives have a hash that does not depend on their layout, so scene files are left out here.
bool IsSceneFile(const std::string& name) {
  return name.ends_with(".pbrt") || name.ends_with(".pbrt.gz");
}

std::uint64_t HashOfFile(const std::string& path) {
  try {
    const Descriptor file(OpenRegularFile(path));
    std::vector<char> block(std::size_t(1) << 20);
    std::uint64_t hash = 0;
    for (;;) {
      std::size_t filled = 0;
      ssize_t count = 1;
      while (filled < block.size() && count > 0) {
        count = read(file.Get(), block.data() + filled, block.size() - filled);
        if (count > 0) filled += std::size_t(count);
      }
      hash = StateChecksum(hash, {block.data(), filled});
      if (filled < block.size()) return hash;
    }
  } catch (const InputFileError&) {
    return 0;
  }
}

}  // namespace

std::vector<InputHash> HashesOfInputs(const RenderSetup& setup) {
  std::vector<InputHash> hashes;
  for (const std::string& name : setup.inputFiles)
    if (name != setup.sceneName && !IsSceneFile(name)) hashes.push_back({name, HashOfFile(name)});
  return hashes;
}

}  // namespace exphoton::cli
