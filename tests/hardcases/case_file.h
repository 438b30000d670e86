// SPDX-License-Identifier: BSD-2-Clause
// The catalogue of hard cases as data: what the files in cases/ say. Their language is described in
// docs/development/robustness.md; this reads it and knows nothing of how a case is judged.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace exphoton::hardcases {

using Values = std::map<std::string, std::string>;

// One thing asked of a run's outcome: "mean", {"0.5", "1%"}.
struct Check {
  std::string kind;
  std::vector<std::string> arguments;
};

// One scene rendered, for one choice of the values in it.
struct Run {
  std::string name;  // unique within its case
  std::string scene;
  std::vector<std::string> arguments;    // after the program's name
  std::vector<std::string> environment;  // NAME=value
  int status = 0;
  int seeds = 1;  // independent pictures; 8 where a mean is asked for
  bool isStrict = true;
  bool isSlow = false;        // of a case that is not
  double timeLimit = 60;      // seconds
  double memoryLimit = 1000;  // megabytes
  std::vector<Check> checks;
};

// A script for bash, in an empty folder; $EXPHOTON is the program. Passes where it exits with 0.
struct Script {
  std::string name, text;
  double timeLimit = 60;
};

// Tests by name: a program (unit, stat ...) and a pattern as GoogleTest's filter knows it.
struct NamedTest {
  std::string program, pattern;
};

struct Case {
  std::string id, title, expected;
  std::string note;  // where the catalogue's expectation had to be corrected, and why
  std::string open;  // why it does not hold, or cannot be asked yet; empty: it must pass
  bool isSlow = false;
  std::vector<NamedTest> tests;
  std::vector<Run> runs;
  std::vector<Script> scripts;
};

struct Group {
  std::string title;
  std::vector<Case> cases;
};

// Every *.txt in the folder, by name; templates of one file serve those after it. Throws
// std::runtime_error that names file and line.
std::vector<Group> ReadCatalogue(const std::string& folder);

}  // namespace exphoton::hardcases
