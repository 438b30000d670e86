// SPDX-License-Identifier: BSD-2-Clause
// VisitSources reads all sources of the project, for tests that check rules of their text.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace exphoton {

inline std::string ReadSource(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Calls visit(path relative to the top, text) for all sources. Returns their number.
template <class Visit>
int VisitSources(const Visit& visit) {
  namespace fs = std::filesystem;
  const fs::path top = EXPHOTON_SOURCE_DIR;
  int count = 0;
  for (const char* folder : {"core", "integrators", "accelerators", "shapes", "lights", "materials",
                             "samplers", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp" && extension != ".inl") continue;
      ++count;
      visit(fs::relative(entry.path(), top).string(), ReadSource(entry.path()));
    }
  return count;
}

}  // namespace exphoton
