// SPDX-License-Identifier: BSD-2-Clause
#include "tests/benchmark/report.h"

#include <cstdio>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace exphoton {
namespace {

std::string Number(double value, int digits = 2) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", value >= 100 ? 0 : value >= 10 ? 1 : digits, value);
  return text;
}

std::string PartOf(const Outcome& outcome) {
  return outcome.name.substr(0, outcome.name.find('/'));
}

std::string RatioText(const Quartiles& ratio) {
  return Number(ratio.median) + " (" + Number(ratio.low) + "–" + Number(ratio.high) + ")";
}

// Returns the speed of the first contestant and its ratio to each of the others.
std::string TableRow(const Outcome& outcome) {
  std::string row = "| " + outcome.name.substr(outcome.name.find('/') + 1) + " | " +
                    Number(outcome.Rate(0)) + " " + outcome.unit + "/s |";
  for (int i = 1; i < int(outcome.contestants.size()); ++i)
    row += " " + RatioText(outcome.Ratio(0, i)) + " |";
  return row + "\n";
}

std::string TableHead(const Outcome& outcome) {
  std::string head = "| " + PartOf(outcome) + " | " + outcome.contestants[0] + " |";
  std::string rule = "| --- | --- |";
  for (std::size_t i = 1; i < outcome.contestants.size(); ++i) {
    head += " against " + outcome.contestants[i] + " |";
    rule += " --- |";
  }
  return head + "\n" + rule + "\n";
}

}  // namespace

void PrintOutcome(const Outcome& outcome, std::ostream& out) {
  out << outcome.name << "  ";
  for (int i = 0; i < int(outcome.contestants.size()); ++i) {
    out << (i ? ", " : "") << outcome.contestants[std::size_t(i)] << " " << Number(outcome.Rate(i));
    if (i > 0) out << " [" << RatioText(outcome.Ratio(0, i)) << "]";
  }
  out << "  " << outcome.unit << "/s\n" << std::flush;
}

std::string MarkdownTables() {
  std::string tables, head;
  for (const Outcome& outcome : Outcomes()) {
    const std::string own = TableHead(outcome);
    if (own != head) tables += "\n" + own;
    head = own;
    tables += TableRow(outcome);
  }
  return tables;
}

void ReplaceTables(const std::string& path, const std::string& tables) {
  std::ifstream in(path);
  std::ostringstream all;
  all << in.rdbuf();
  const std::string text = all.str(), begin = "<!-- benchmark -->\n", end = "<!-- end -->";
  const std::size_t from = text.find(begin), to = text.find(end);
  if (!in || from == std::string::npos || to == std::string::npos || to < from)
    throw std::runtime_error("no place for tables in " + path);
  std::ofstream out(path);
  out << text.substr(0, from + begin.size()) << tables << "\n" << text.substr(to);
}

int CheckFloors(const std::string& path, std::ostream& out) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  int below = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::string name, contestant, opponent;
    double floor = 0;
    if (!(words >> name >> contestant >> opponent >> floor))
      throw std::runtime_error(path + ": not a floor: " + line);
    for (const Outcome& outcome : Outcomes()) {
      if (outcome.name != name) continue;
      const int own = outcome.IndexOf(contestant), other = outcome.IndexOf(opponent);
      if (own < 0 || other < 0) throw std::runtime_error(path + ": no such contestants: " + line);
      const Quartiles ratio = outcome.Ratio(own, other);
      if (ratio.median >= floor) continue;
      out << name << ": " << contestant << " is " << RatioText(ratio) << " times as fast as "
          << opponent << ", the floor is " << Number(floor) << "\n";
      ++below;
    }
  }
  return below;
}

}  // namespace exphoton
