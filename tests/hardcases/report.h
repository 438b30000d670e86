// SPDX-License-Identifier: BSD-2-Clause
// TerminalLine and Page print the table of all cases: on the terminal while they run, and as a page
// in Markdown.
#pragma once

#include <string>
#include <vector>

#include "tests/hardcases/case_file.h"

namespace exphoton::hardcases {

enum class State { Passed, Failed, Open, LeftOut };

struct Line {
  const Group* group = nullptr;
  const Case* asked = nullptr;
  State state = State::LeftOut;
  std::string seen;
  std::vector<std::string> failures;
  std::vector<double> falseAlarms;  // of each mean
  double seconds = 0, megabytes = 0;
};

std::string TerminalLine(const Line& line);

// Returns the probability that any of the measured means would fail with other seeds, as text.
std::string FalseAlarmText(const std::vector<Line>& lines);

// Summary returns a table with one row per group. Page returns the tables of all cases.
std::string Summary(const std::vector<Line>& lines);
std::string Page(const std::vector<Line>& lines);

}  // namespace exphoton::hardcases
