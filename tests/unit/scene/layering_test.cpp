// SPDX-License-Identifier: BSD-2-Clause
// These tests check the layers of the core. A folder of core/ may include only folders below it,
// and no plugin. No source file may be too long to read at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace exphoton {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kLayers{"base",   "files",     "math",    "geometry", "scattering",
                                       "lights", "sampling",  "spatial", "imaging",  "cameras",
                                       "scene",  "transport", "render",  "params",   "plugins",
                                       "parser", "app"};

int LayerOf(const std::string& folder) {
  const auto it = std::find(kLayers.begin(), kLayers.end(), folder);
  return it == kLayers.end() ? -1 : int(it - kLayers.begin());
}

bool IsSource(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

std::vector<std::string> Lines(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// Returns "core/math/vec.h" for the line #include "core/math/vec.h", and "" for other lines.
std::string Included(const std::string& line) {
  const std::string start = "#include \"";
  if (line.compare(0, start.size(), start) != 0) return "";
  return line.substr(start.size(), line.rfind('"') - start.size());
}

TEST(Layering, AFolderOfTheCoreIncludesOnlyWhatStandsBelowIt) {
  const fs::path core = fs::path(EXPHOTON_SOURCE_DIR) / "core";
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(core)) {
    if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
    const fs::path relative = fs::relative(entry.path(), core);
    const std::string folder = relative.begin()->string();
    // The header for plugin authors is above all layers, and cameras are plugins.
    if (relative == "plugin.h" || folder == "cameras") continue;
    ASSERT_GE(LayerOf(folder), 0) << relative << " is in no known layer";
    for (const std::string& line : Lines(entry.path())) {
      const std::string included = Included(line);
      if (included.empty()) continue;
      ASSERT_EQ(included.compare(0, 5, "core/"), 0) << relative << " includes " << included;
      const std::string other = included.substr(5, included.find('/', 5) - 5);
      EXPECT_LE(LayerOf(other), LayerOf(folder)) << relative << " includes " << included;
      ++checked;
    }
  }
  EXPECT_GT(checked, 300);
}

TEST(Layering, NoSourceFileHasMoreThan500Lines) {
  for (const char* folder : {"core", "integrators", "accelerators", "shapes", "lights", "materials",
                             "samplers", "tests"})
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(EXPHOTON_SOURCE_DIR) / folder)) {
      if (!entry.is_regular_file() || !IsSource(entry.path())) continue;
      EXPECT_LE(Lines(entry.path()).size(), 500u) << entry.path();
    }
}

}  // namespace
}  // namespace exphoton
