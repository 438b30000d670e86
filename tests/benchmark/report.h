// SPDX-License-Identifier: BSD-2-Clause
// PrintOutcome, MarkdownTables and CheckFloors report contests: as a line, as tables for docs, and
// by the floors below which a ratio counts as a failure.
#pragma once

#include <iosfwd>
#include <string>

#include "tests/benchmark/contest.h"

namespace exphoton {

// Prints one line: all speeds, and the ratio of the first contestant to each of the others.
void PrintOutcome(const Outcome& outcome, std::ostream& out);

// Returns Markdown tables of all outcomes, one for each part.
std::string MarkdownTables();

// Replaces the text between the lines "<!-- benchmark -->" and "<!-- end -->" of a file. Throws
// std::runtime_error if these lines are missing.
void ReplaceTables(const std::string& path, const std::string& tables);

// Compares the outcomes with a file of lines "contest contestant opponent floor". Prints the ratios
// below their floor and returns their number. Skips contests that have not run.
int CheckFloors(const std::string& path, std::ostream& out);

}  // namespace exphoton
