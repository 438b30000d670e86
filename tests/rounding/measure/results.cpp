// SPDX-License-Identifier: BSD-2-Clause
// Results are texts in lines, which people compare with those of an earlier run.
#include "tests/rounding/measure/results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tests/rounding/measure/print.h"

namespace exphoton::rounding {
namespace {

constexpr const char* kBegin = "<!-- digits -->\n";
constexpr const char* kEnd = "<!-- end -->\n";
constexpr std::size_t kPageWidth = 100;
constexpr std::size_t kNameWidth = 40;  // in lines

const Limit* LimitOf(const std::vector<Limit>& limits, const std::string& name) {
  for (const Limit& limit : limits)
    if (limit.name == name) return &limit;
  return nullptr;
}

}  // namespace

std::string NameOf(const Subject& subject) {
  return subject.file.empty() ? subject.name : subject.group + " " + subject.name;
}

std::string RowNameOf(const Subject& subject) {
  const std::string all = NameOf(subject);
  return subject.file.empty() ? all.substr(0, all.find(' ')) : all;
}

std::string LineOf(const Result& result) {
  const Spread& spread = result.spread;
  return Print("%-40.40s mean %.1f  median %.1f  worst %.1f  decided %5.1f %%  %6.2f s",
               NameOf(result.subject).c_str(), spread.mean, spread.median, spread.worst,
               100 * spread.decided, result.seconds);
}

EarlierLines::EarlierLines(std::istream& in) {
  for (std::string line; std::getline(in, line);) {
    Spread spread;
    if (line.size() < kNameWidth ||
        std::sscanf(line.c_str() + kNameWidth, " mean %lf median %lf worst %lf decided %lf %%",
                    &spread.mean, &spread.median, &spread.worst, &spread.decided) != 4)
      continue;
    spread.decided /= 100;
    spreads_.emplace(line.substr(0, kNameWidth), spread);
  }
}

std::optional<Spread> EarlierLines::Take(const Subject& subject) {
  std::string name = NameOf(subject);
  name.resize(kNameWidth, ' ');
  const auto found = spreads_.find(name);
  if (found == spreads_.end()) return {};
  const Spread spread = found->second;
  spreads_.erase(found);
  return spread;
}

std::vector<Row> RowsOf(const std::vector<Result>& results) {
  std::vector<Row> rows;
  for (const Result& result : results) {
    const std::string name = RowNameOf(result.subject);
    if (rows.empty() || rows.back().name != name)
      rows.push_back({result.subject.file.empty() ? result.subject.group : "Scenes", name, 0, {}});
    Row& row = rows.back();
    ++row.runs;
    row.most.mean = std::max(row.most.mean, result.spread.mean);
    row.most.median = std::max(row.most.median, result.spread.median);
    row.most.worst = std::max(row.most.worst, result.spread.worst);
    row.most.decided = std::max(row.most.decided, result.spread.decided);
  }
  return rows;
}

std::vector<Limit> ReadLimits(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + ": no such file");
  std::vector<Limit> limits;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    Limit limit;
    std::istringstream words(line);
    words >> limit.mean >> limit.median >> std::ws;
    if (!std::getline(words, limit.name)) throw std::runtime_error(path + ": wrong line: " + line);
    limits.push_back(limit);
  }
  return limits;
}

std::string LimitsText(const std::vector<Row>& rows) {
  std::string text =
      "# The most digits that rounding may cost: of the mean, of the median pixel, and the name "
      "of\n"
      "# the hard case or scene. ./dev digits --write-limits makes this file.\n";
  for (const Row& row : rows)
    text += Print("%.1f %.1f %s\n", row.most.mean + kMargin, row.most.median + kMargin,
                  row.name.c_str());
  return text;
}

std::vector<std::string> Excesses(const std::vector<Row>& rows, const std::vector<Limit>& limits) {
  std::vector<std::string> excesses;
  for (const Row& row : rows) {
    const Limit* limit = LimitOf(limits, row.name);
    if (!limit)
      excesses.push_back(row.name + " has no limit");
    else if (row.most.mean > limit->mean)
      excesses.push_back(Print("%s: the mean loses %.2f digits, the limit is %.1f",
                               row.name.c_str(), row.most.mean, limit->mean));
    else if (row.most.median > limit->median)
      excesses.push_back(Print("%s: the median pixel loses %.2f digits, the limit is %.1f",
                               row.name.c_str(), row.most.median, limit->median));
  }
  return excesses;
}

std::vector<std::string> NotMeasured(const std::vector<Row>& rows,
                                     const std::vector<Limit>& limits) {
  std::vector<std::string> names;
  for (const Limit& limit : limits)
    if (std::none_of(rows.begin(), rows.end(),
                     [&](const Row& row) { return row.name == limit.name; }))
      names.push_back(limit.name);
  return names;
}

std::string LeftOutText(const std::vector<LeftOut>& leftOut) {
  // "3 vertex/nan" and "3 vertex/inf" become "3 vertex (2)".
  std::map<std::string, std::vector<std::pair<std::string, int>>> byReason;
  for (const LeftOut& each : leftOut) {
    auto& names = byReason[each.reason];
    const std::string name = each.name.substr(0, each.name.find('/'));
    if (names.empty() || names.back().first != name) names.push_back({name, 0});
    ++names.back().second;
  }
  std::string text;
  for (const auto& [reason, names] : byReason) {
    std::string line = "- " + reason + ":";
    for (const auto& [name, count] : names) {
      const std::string word = " " + name + (count > 1 ? Print(" (%d)", count) : "") +
                               (name == names.back().first ? "." : ",");
      if (line.size() + word.size() > kPageWidth) {
        text += line + "\n";
        line = " ";
      }
      line += word;
    }
    text += line + "\n";
  }
  return text;
}

void WriteTables(const std::vector<Row>& rows, const std::vector<Limit>& limits,
                 const std::vector<LeftOut>& leftOut, const std::string& path) {
  std::string tables, group;
  for (const Row& row : rows) {
    if (row.group != group) {
      group = row.group;
      tables += "\n**" + group +
                "**\n\n| case | scenes | mean (limit) | median pixel (limit) | worst pixel | "
                "decided |\n| --- | --- | --- | --- | --- | --- |\n";
    }
    const Limit* limit = LimitOf(limits, row.name);
    if (!limit) throw std::runtime_error(row.name + " has no limit");
    tables += Print("| %s | %d | %.1f (%.1f) | %.1f (%.1f) | %.1f | %.1f %% |\n", row.name.c_str(),
                    row.runs, row.most.mean, limit->mean, row.most.median, limit->median,
                    row.most.worst, 100 * row.most.decided);
  }
  if (!leftOut.empty()) tables += "\n**Left out**\n\n" + LeftOutText(leftOut);
  std::ostringstream old;
  old << std::ifstream(path).rdbuf();
  std::string page = old.str();
  const std::size_t begin = page.find(kBegin), end = page.find(kEnd);
  if (begin == std::string::npos || end == std::string::npos || end < begin)
    throw std::runtime_error(path + " has no marks for the tables");
  const std::size_t from = begin + std::string(kBegin).size();
  page.replace(from, end - from, tables + "\n");
  std::ofstream(path) << page;
}

}  // namespace exphoton::rounding
