// SPDX-License-Identifier: BSD-2-Clause
// Results of the measurement of lost digits: lines for the terminal, rows of one case or scene,
// their limits in tests/rounding/limits.txt, and tables for a page.
#pragma once

#include <iosfwd>
#include <map>
#include <optional>
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
// EarlierLines holds the lines that a run has printed, with one decimal of each value.
class EarlierLines {
 public:
  explicit EarlierLines(std::istream& in);
  // Returns and removes the line of a subject. Subjects whose names have the same first 40
  // characters belong to one case, so it does not matter which of them gets which line.
  std::optional<Spread> Take(const Subject& subject);

 private:
  std::multimap<std::string, Spread> spreads_;  // by name
};
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

// Returns the names that have a limit and no row.
std::vector<std::string> NotMeasured(const std::vector<Row>& rows,
                                     const std::vector<Limit>& limits);

// Returns a paragraph for each reason, with the cases, and scripts, that are left out for it.
std::string LeftOutText(const std::vector<LeftOut>& leftOut);
// Replaces the tables of the page between its marks.
void WriteTables(const std::vector<Row>& rows, const std::vector<Limit>& limits,
                 const std::vector<LeftOut>& leftOut, const std::string& path);

}  // namespace exphoton::rounding
