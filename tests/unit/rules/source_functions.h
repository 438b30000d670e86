// SPDX-License-Identifier: BSD-2-Clause
// FindFunctions lists the functions that a C++ source defines at namespace or class scope, with
// their lengths. It reads braces and parentheses of sources in the layout of clang-format. It is
// not a C++ parser: lambdas belong to the function around them.
#pragma once

#include <string>
#include <vector>

namespace exphoton {

struct SourceFunction {
  std::string name;   // "Film::AddSample", or "TEST" for a test
  int line = 0;       // of the first line, from 1
  int lines = 0;      // up to the closing brace
  int arguments = 0;  // of the parameter list
  bool isConstructor = false;
};

// Throws std::runtime_error if braces do not match.
std::vector<SourceFunction> FindFunctions(const std::string& source);

// Returns the source with blanks in place of comments, literals and preprocessor lines.
std::string BlankLiterals(const std::string& source);

}  // namespace exphoton
