// SPDX-License-Identifier: BSD-2-Clause
// These tests check the Markdown pages: links and paths name files that exist, and prose wraps at
// 100 columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace exphoton {
namespace {

namespace fs = std::filesystem;

const fs::path kTop = EXPHOTON_SOURCE_DIR;

std::vector<fs::path> Pages() {
  std::vector<fs::path> pages{kTop / "README.md"};
  for (const char* folder : {"docs", "scenes", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(kTop / folder))
      if (entry.path().extension() == ".md") pages.push_back(entry.path());
  return pages;
}

// Calls visit(line number, line) for the lines of a page outside blocks between ``` lines.
template <class Visit>
void VisitProse(const fs::path& page, const Visit& visit) {
  std::ifstream file(page);
  bool isCode = false;
  int number = 1;
  for (std::string line; std::getline(file, line); ++number) {
    if (line.starts_with("```")) isCode = !isCode;
    if (!isCode) visit(number, line);
  }
}

// Calls visit(first group) for each match.
template <class Visit>
void VisitMatches(const std::string& text, const std::regex& pattern, const Visit& visit) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    visit((*match)[1].str());
}

// Returns whether a path names a file or folder, or the .h and .cpp of that name.
bool Exists(const fs::path& path) {
  return fs::exists(path) || fs::exists(path.string() + ".h") || fs::exists(path.string() + ".cpp");
}

TEST(Pages, LinksLeadToFiles) {
  const std::regex link(R"(\]\(([^)#\s]+)[^)]*\))");
  int checked = 0;
  for (const fs::path& page : Pages())
    VisitProse(page, [&](int number, const std::string& line) {
      VisitMatches(line, link, [&](const std::string& target) {
        if (target.find("://") != std::string::npos) return;
        ++checked;
        EXPECT_TRUE(fs::exists(page.parent_path() / target))
            << page << ":" << number << ": " << target;
      });
    });
  EXPECT_GT(checked, 100);
}

// Decision records are not checked, because they keep names that no longer exist. Words in capitals
// are not checked either; they are placeholders, as in `scenes/NAME/`.
TEST(Pages, PathsInCodeSpansExist) {
  const std::regex path(
      "`((?:core|integrators|accelerators|shapes|lights|materials|samplers|scenes|tests|docs)"
      "/[a-z0-9_./-]+)`");
  const std::vector<std::string> others{"lights/further"};  // a counter of --stats-json
  int checked = 0;
  for (const fs::path& page : Pages()) {
    if (page.parent_path().filename() == "decisions") continue;
    VisitProse(page, [&](int number, const std::string& line) {
      VisitMatches(line, path, [&](const std::string& name) {
        if (std::find(others.begin(), others.end(), name) != others.end()) return;
        ++checked;
        EXPECT_TRUE(Exists(kTop / name)) << page << ":" << number << ": " << name;
      });
    });
  }
  EXPECT_GT(checked, 50);
}

TEST(Pages, WrapAtAHundredColumns) {
  for (const fs::path& page : Pages())
    VisitProse(page, [&](int number, const std::string& line) {
      if (line.starts_with("|") || line.starts_with("    ")) return;
      const auto columns = std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // no continuation byte
      });
      EXPECT_LE(columns, 100) << page << ":" << number;
    });
}

}  // namespace
}  // namespace exphoton
