// SPDX-License-Identifier: BSD-2-Clause
// Text for people; nothing here decides anything.
#include "tests/hardcases/report.h"

#include <array>
#include <cstdio>

namespace exphoton::hardcases {
namespace {

const char* WordFor(State state) {
  switch (state) {
    case State::Passed:
      return "pass";
    case State::Failed:
      return "FAIL";
    case State::Open:
      return "open";
    case State::LeftOut:
      return "-";
  }
  return "";
}

std::string Escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result;
}

struct Tally {
  std::array<int, 4> states{};
  void Add(const Line& line) { ++states[std::size_t(line.state)]; }
  int Of(State state) const { return states[std::size_t(state)]; }
};

std::string Row(const std::string& title, const Tally& tally) {
  std::string row = "| " + title + " |";
  for (const State state : {State::Passed, State::Failed, State::Open, State::LeftOut})
    row += " " + std::to_string(tally.Of(state)) + " |";
  return row + "\n";
}

}  // namespace

std::string TerminalLine(const Line& line) {
  std::array<char, 64> start{};
  std::snprintf(start.data(), start.size(), "%-4s %-5s %6.1f s  ", line.asked->id.c_str(),
                WordFor(line.state), line.seconds);
  std::string text = start.data() + line.asked->title + "\n";
  if (!line.seen.empty()) text += "                     " + line.seen + "\n";
  for (const auto& failure : line.failures) text += "      " + failure + "\n";
  return text;
}

std::string Summary(const std::vector<Line>& lines) {
  std::string text = "| group | pass | fail | open | left out |\n| --- | --- | --- | --- | --- |\n";
  Tally all, tally;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    tally.Add(lines[i]);
    all.Add(lines[i]);
    if (i + 1 < lines.size() && lines[i + 1].group == lines[i].group) continue;
    text += Row(lines[i].group->title, tally);
    tally = {};
  }
  return text + Row("**all**", all);
}

std::string FalseAlarmText(const std::vector<Line>& lines) {
  double none = 1, most = 0;
  int count = 0;
  std::string where;
  for (const Line& line : lines) {
    for (const double rate : line.falseAlarms) {
      ++count;
      none *= 1 - rate;
      if (rate > most) most = rate, where = line.asked->id;
    }
  }
  if (count == 0) return "";
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "%d means over seeds; with other seeds one of them fails by chance in %.2g of all "
                "runs (most often: case %s, %.2g)\n",
                count, 1 - none, where.empty() ? "-" : where.c_str(), most);
  return text.data();
}

std::string Page(const std::vector<Line>& lines) {
  std::string text;
  const Group* group = nullptr;
  for (const Line& line : lines) {
    if (line.group != group) {
      group = line.group;
      text += "\n### " + group->title +
              "\n\n| case | input | expected | seen | |\n| --- | --- | --- | --- | --- |\n";
    }
    std::string seen = line.seen;
    for (const auto& failure : line.failures) seen += (seen.empty() ? "" : "; ") + failure;
    if (!line.asked->open.empty()) seen += (seen.empty() ? "" : "; ") + line.asked->open;
    if (!line.asked->note.empty()) seen += (seen.empty() ? "*" : "; *") + line.asked->note + "*";
    text += "| " + line.asked->id + " | " + Escaped(line.asked->title) + " | " +
            Escaped(line.asked->expected) + " | " + Escaped(seen) + " | " + WordFor(line.state) +
            " |\n";
  }
  return text;
}

}  // namespace exphoton::hardcases
