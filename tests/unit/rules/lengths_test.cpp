// SPDX-License-Identifier: BSD-2-Clause
// These tests check the lengths that docs/development/CONTRIBUTING.md states: lines of a file,
// lines of a function and arguments of a function.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/unit/rules/source_files.h"
#include "tests/unit/rules/source_functions.h"

namespace exphoton {
namespace {

constexpr int kFileLines = 400, kFunctionLines = 50, kArguments = 5;

// CONTRIBUTING.md states why each may be longer.
const std::set<std::string> kLongFunctions{
    "integrators/photon/photon_settings.cpp PhotonParameters",  // a table of parameters
};
const std::set<std::string> kManyArguments{
    // Kernels: a struct would pass through memory what registers hold.
    "accelerators/bvh/traverse/real8.inl Push",
    "core/spatial/closest_disk.inl Descend",
    "integrators/photon/gather/cone_directions_simd.cpp Count",
    // The C library fixes the arguments.
    "tests/hardcases/preload/failing_allocations.cpp __libc_start_main",
};

TEST(Layering, NoSourceFileIsTooLong) {
  const int sources = VisitSources([](const std::string& path, const std::string& text) {
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), kFileLines) << path;
  });
  EXPECT_GT(sources, 500);
}

TEST(Layering, NoFunctionIsTooLongOrHasTooManyArguments) {
  std::set<std::string> longFunctions, manyArguments;
  std::size_t functions = 0;
  VisitSources([&](const std::string& path, const std::string& text) {
    const auto found = FindFunctions(text);
    functions += found.size();
    for (const SourceFunction& function : found) {
      const std::string name = path + " " + function.name;
      if (function.lines >= kFunctionLines) longFunctions.insert(name);
      if (function.arguments > kArguments && !function.isConstructor) manyArguments.insert(name);
    }
  });
  EXPECT_EQ(longFunctions, kLongFunctions);
  EXPECT_EQ(manyArguments, kManyArguments);
  EXPECT_GT(functions, 4000u);
}

TEST(Layering, TheLengthsAreThoseThatContributingStates) {
  std::string page = ReadSource(EXPHOTON_SOURCE_DIR "/docs/development/CONTRIBUTING.md");
  std::replace(page.begin(), page.end(), '\n', ' ');
  const std::string sentence = "Files have at most " + std::to_string(kFileLines) +
                               " lines, functions fewer than " + std::to_string(kFunctionLines) +
                               ", and functions at most " + std::to_string(kArguments) +
                               " arguments.";
  EXPECT_NE(page.find(sentence), std::string::npos) << sentence;
}

constexpr const char* kSample = R"text(#include <vector>
namespace a {
// A comment with { and "quotes".
class B : public C {
 public:
  explicit B(int x, std::vector<int> y = {1, 2}) : x_{x}, y_(y) {}
  int One() const { return '{'; }
  bool operator()(int a, std::map<int, int> b) const {
    const auto f = [&](int c) {
      return c;
    };
    return f(a) == 1'000;
  }

 private:
  int x_ = 0, y_[2] = {0, 0};
};
#define OPEN {
const std::vector<std::string> kNames{"}", R"x(})x"};
template <class T>
auto Long(T a, T b,
          T c) {
  struct Local {
    int Inner() { return 1; }
  };
  if (a) {
    return b;
  }
  return c;
}
enum class E { A, B };
}  // namespace a
TEST(Suite, Name) {
}
)text";

TEST(Layering, FindsFunctionsWithTheirLengthsAndArguments) {
  const auto functions = FindFunctions(kSample);
  const std::vector<SourceFunction> expected{{"B", 6, 1, 2, true},
                                             {"One", 7, 1, 0, false},
                                             {"operator()", 8, 6, 2, false},
                                             {"Long", 20, 11, 3, false},
                                             {"TEST", 33, 2, 2, false}};
  ASSERT_EQ(functions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(functions[i].name, expected[i].name);
    EXPECT_EQ(functions[i].line, expected[i].line) << expected[i].name;
    EXPECT_EQ(functions[i].lines, expected[i].lines) << expected[i].name;
    EXPECT_EQ(functions[i].arguments, expected[i].arguments) << expected[i].name;
    EXPECT_EQ(functions[i].isConstructor, expected[i].isConstructor) << expected[i].name;
  }
  EXPECT_THROW(FindFunctions("void F() {"), std::runtime_error);
}

}  // namespace
}  // namespace exphoton
