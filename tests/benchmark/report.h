// SPDX-License-Identifier: BSD-2-Clause
// What contests gave: a table for docs, and the floors below which a ratio counts as a failure.
#pragma once

#include <iosfwd>
#include <string>

#include "tests/benchmark/contest.h"

namespace exphoton {

// One line: speeds, and how the first contestant stands to the others.
void PrintOutcome(const Outcome& outcome, std::ostream& out);

// Tables of all outcomes, one for each part, in Markdown.
std::string MarkdownTables();

// Replaces what stands between the lines "<!-- benchmark -->" and "<!-- end -->" of a file. Throws
// std::runtime_error where they are not there.
void ReplaceTables(const std::string& path, const std::string& tables);

// Compares with a file of lines "contest contestant opponent floor". Says what is below; returns
// how many are. Contests that have not run are passed over.
int CheckFloors(const std::string& path, std::ostream& out);

}  // namespace exphoton
