// SPDX-License-Identifier: BSD-2-Clause
// The table of all cases: on the terminal while they run, and as a page in Markdown.
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

// How often the means that were measured would fail with other seeds, all together.
std::string FalseAlarmText(const std::vector<Line>& lines);

// A summary by group, and the table of cases.
std::string Summary(const std::vector<Line>& lines);
std::string Page(const std::vector<Line>& lines);

}  // namespace exphoton::hardcases
