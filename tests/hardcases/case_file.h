// SPDX-License-Identifier: BSD-2-Clause
// ReadCatalogue reads the catalogue of hard cases from the files in cases/.
// docs/development/robustness.md describes their language. This file does not depend on how a case
// is judged.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace exphoton::hardcases {

using Values = std::map<std::string, std::string>;

// Check is one requirement on a run's outcome: "mean", {"0.5", "1%"}.
struct Check {
  std::string kind;
  std::vector<std::string> arguments;
};

// Run is one scene to render, with one choice of the values in it.
struct Run {
  std::string name;  // unique within its case
  std::string scene;
  std::vector<std::string> arguments;    // after the program's name
  std::vector<std::string> environment;  // NAME=value
  int status = 0;
  int seeds = 1;  // number of independent pictures; at least 8 to check a mean
  bool isStrict = true;
  bool isSlow = false;        // only this run, not the whole case
  double timeLimit = 60;      // seconds
  double memoryLimit = 1000;  // megabytes
  std::vector<Check> checks;
};

// Script is a bash script that runs in an empty folder; $EXPHOTON is the program. Exit status 0
// passes. Status 77 leaves the case out, because something that it needs is missing.
struct Script {
  std::string name, text;
  double timeLimit = 60;
};

// NamedTest selects tests of a program (unit, stat ...) by a wildcard pattern of test names.
struct NamedTest {
  std::string program, pattern;
};

struct Case {
  std::string id, title, expected;
  std::string note;  // how and why the catalogue's expectation was corrected
  std::string open;  // why it fails or cannot be tested yet; empty: it must pass
  bool isSlow = false;
  std::vector<NamedTest> tests;
  std::vector<Run> runs;
  std::vector<Script> scripts;
};

struct Group {
  std::string title;
  std::vector<Case> cases;
};

// Reads all *.txt in the folder in the order of their names. Later files may use templates of
// earlier ones. Throws std::runtime_error with file and line.
std::vector<Group> ReadCatalogue(const std::string& folder);

}  // namespace exphoton::hardcases
