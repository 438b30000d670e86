// SPDX-License-Identifier: BSD-2-Clause
// Results of the measurement of lost digits: lines for the terminal, rows of one case or scene,
// their limits in tests/rounding/limits.txt, and tables for a page.
#pragma once

#include <string>
#include <vector>

#include "tests/rounding/measure/spread.h"
#include "tests/rounding/measure/subjects.h"

namespace exphoton::rounding {

struct Result {
  Subject subject;
  Spread spread;
  double seconds = 0;  // CPU time
};

// Row holds the largest digits of all runs of a hard case, or those of a scene and integrator.
struct Row {
  std::string group, name;
  int runs = 0;
  Spread most;
};

std::string NameOf(const Subject& subject);     // "T1 matte.2", "cloister path"
std::string RowNameOf(const Subject& subject);  // "T1"; of a scene its name
std::string LineOf(const Result& result);
std::vector<Row> RowsOf(const std::vector<Result>& results);

// Limits are lines "mean median NAME". A row without a limit is an excess, too.
struct Limit {
  double mean = 0, median = 0;
  std::string name;
};
std::vector<Limit> ReadLimits(const std::string& path);
// Limits are this much above the measured digits, because other code rounds in other directions.
inline constexpr double kMargin = .5;
std::string LimitsText(const std::vector<Row>& rows);
// Returns a sentence for each row that is above its limit.
std::vector<std::string> Excesses(const std::vector<Row>& rows, const std::vector<Limit>& limits);

// Replaces the tables of the page between its marks.
void WriteTables(const std::vector<Row>& rows, const std::vector<Limit>& limits,
                 const std::string& path);

}  // namespace exphoton::rounding
