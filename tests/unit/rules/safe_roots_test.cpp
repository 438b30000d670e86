// SPDX-License-Identifier: BSD-2-Clause
// These tests look for square roots and arc functions whose argument rounding can move out of their
// domain, where they return NaN. Such calls use SafeSqrt, SafeAcos or SafeAsin of core/math/real.h.
// In double they bound the argument in place: std::sqrt(std::max(x, 0.)).
#include <gtest/gtest.h>

#include <cctype>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/unit/rules/source_files.h"
#include "tests/unit/rules/source_functions.h"

namespace exphoton {
namespace {

// Differences that no rounding makes negative: the file and the argument of std::sqrt.
const std::set<std::string> kRootsInRange{
    "shapes/disk.cpp inner2 + double(u.x) * (outer2 - inner2)",  // between two squares
    "shapes/quadric/revolved_quadric.cpp 5 - root",              // constants
};

bool IsWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Returns the source without comments and literals, with one blank for each run of blanks.
std::string InOneLine(const std::string& source) {
  std::string line;
  for (const char c : BlankLiterals(source)) {
    const bool isBlank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!isBlank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  return line;
}

// Returns the argument of each call of a mathematical function, such as "sqrt".
std::vector<std::string> ArgumentsOf(const std::string& function, const std::string& line) {
  std::vector<std::string> arguments;
  for (std::size_t at = 0; (at = line.find(function, at)) != std::string::npos;) {
    const bool isName = at == 0 || !IsWordCharacter(line[at - 1]);
    at += function.size();
    if (at < line.size() && (line[at] == 'f' || line[at] == 'l')) ++at;  // sqrtf, sqrtl
    if (!isName || at == line.size() || line[at] != '(') continue;
    ++at;
    std::size_t end = at;
    for (int depth = 1; depth > 0 && end < line.size(); ++end)
      depth += line[end] == '(' ? 1 : line[end] == ')' ? -1 : 0;
    std::string argument = line.substr(at, end - 1 - at);
    if (argument.starts_with(' ')) argument.erase(0, 1);
    arguments.push_back(argument);
  }
  return arguments;
}

// Returns whether the argument has a minus between two terms, outside the arguments of calls. A
// count less a whole number, as in "(count - 1)", is no difference.
bool HasDifference(const std::string& argument) {
  static const std::regex count(R"(\((\w+) - \d+\))");
  const std::string text = std::regex_replace(argument, count, "$1");
  int calls = 0;
  std::vector<int> open;  // for each open bracket: 1 if it belongs to a call
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' || c == '[' || c == '{') {
      open.push_back(c != '(' || (i > 0 && (IsWordCharacter(text[i - 1]) || text[i - 1] == '>')));
      calls += open.back();
    } else if (!open.empty() && (c == ')' || c == ']' || c == '}')) {
      calls -= open.back();
      open.pop_back();
    } else if (calls == 0 && text.compare(i, 3, " - ") == 0) {
      return true;
    }
  }
  return false;
}

TEST(SafeRoots, NoArgumentLeavesItsDomainByRounding) {
  int calls = 0;
  std::set<std::string> roots;
  VisitSources([&](const std::string& path, const std::string& source) {
    if (path.starts_with("tests/")) return;
    const std::string line = InOneLine(source);
    for (const char* function : {"acos", "asin"})
      for (const std::string& argument : ArgumentsOf(function, line)) {
        ++calls;
        EXPECT_TRUE(argument.starts_with("std::clamp("))
            << path << ": " << function << "(" << argument << ")";
      }
    for (const std::string& argument : ArgumentsOf("sqrt", line)) {
      ++calls;
      if (HasDifference(argument) && !argument.starts_with("std::max("))
        roots.insert(path + " " + argument);
    }
  });
  EXPECT_EQ(roots, kRootsInRange);
  EXPECT_GT(calls, 100);
}

TEST(SafeRoots, AreFoundInSources) {
  const std::string line = InOneLine(
      "// sqrt(1)\nReal a = std::sqrt(\n    b -\n    c(d)) + SafeSqrt(e) + sqrtf(f);\n"
      "const char* text = \"sqrt(g)\";  // sqrt(h)\ndouble i = std::acos(sqrt(1 - j));\n");
  EXPECT_EQ(ArgumentsOf("sqrt", line), (std::vector<std::string>{"b - c(d)", "f", "1 - j"}));
  EXPECT_EQ(ArgumentsOf("acos", line), (std::vector<std::string>{"sqrt(1 - j)"}));
  for (const char* difference : {"1 - x", "2 * (1 - x)", "f(x) - g(x)", "(a - b) * (a + b)",
                                 "x / (1 - y)", "std::cos(a / 3) / b - 1"})
    EXPECT_TRUE(HasDifference(difference)) << difference;
  for (const char* other : {"x", "-x", "f(a - b)", "squares / (count - 1)", "m[i - 1]",
                            "double(n.size() - 1)", "1e-7 * x", "p->x", "std::max<int>(a - b, 0)"})
    EXPECT_FALSE(HasDifference(other)) << other;
}

}  // namespace
}  // namespace exphoton
