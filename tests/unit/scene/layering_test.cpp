// SPDX-License-Identifier: BSD-2-Clause
// These tests check the house rules: a folder of core/ includes only folders below it and no
// plugin, no folder is too large, and comments and pages avoid the phrases that
// docs/development/CONTRIBUTING.md names. tests/unit/rules/ checks the lengths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
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
  return path.extension() == ".h" || path.extension() == ".cpp" || path.extension() == ".inl";
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

const std::vector<std::string> kPrivatePhrases{
    "told", "tells", "whom", "in vain", "nobody", "so many", "that of", "as many as", "of those"};

// Returns the comment of a line of C++; for Markdown, the line, unless it is code.
std::string ProseOf(const std::string& line, bool isMarkdown) {
  if (isMarkdown) return line.starts_with("    ") ? "" : line;
  const std::size_t comment = line.find("//");
  return comment == std::string::npos ? "" : line.substr(comment);
}

// CONTRIBUTING.md lists the phrases, so it is left out.
TEST(Language, CommentsAndPagesHaveNoneOfThePhrasesThatContributingNames) {
  int checked = 0;
  const fs::path top = EXPHOTON_SOURCE_DIR;
  std::vector<fs::path> files{top / "README.md"};
  for (const char* folder : {"core", "integrators", "accelerators", "shapes", "lights", "materials",
                             "samplers", "tests", "docs", "scenes"})
    for (const auto& entry : fs::recursive_directory_iterator(top / folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
  for (const fs::path& path : files) {
    const bool isMarkdown = path.extension() == ".md";
    if (!IsSource(path) && !isMarkdown) continue;
    if (path.filename() == "CONTRIBUTING.md") continue;
    ++checked;
    bool isCode = false;
    for (const std::string& line : Lines(path)) {
      if (isMarkdown && line.starts_with("```")) isCode = !isCode;
      const std::string prose = " " + ProseOf(line, isMarkdown) + " ";
      for (const std::string& phrase : kPrivatePhrases) {
        const std::size_t at = isCode ? std::string::npos : prose.find(phrase);
        if (at == std::string::npos) continue;
        const bool isWord = !std::isalpha(static_cast<unsigned char>(prose[at - 1])) &&
                            !std::isalpha(static_cast<unsigned char>(prose[at + phrase.size()]));
        EXPECT_FALSE(isWord) << path << ": \"" << phrase << "\" in: " << line;
      }
    }
  }
  EXPECT_GT(checked, 600);
}

TEST(Layering, NoFolderHasMoreThanTwentySources) {
  const fs::path top = EXPHOTON_SOURCE_DIR;
  for (const char* folder : {"core", "integrators", "accelerators", "shapes", "lights", "materials",
                             "samplers", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      if (!entry.is_directory()) continue;
      const auto sources =
          std::count_if(fs::directory_iterator(entry.path()), fs::directory_iterator(),
                        [](const auto& file) { return IsSource(file.path()); });
      EXPECT_LE(sources, 20) << entry.path();
    }
}

}  // namespace
}  // namespace exphoton
