// SPDX-License-Identifier: BSD-2-Clause
// These functions only format results as text. They decide nothing.
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
  constexpr double kWorthNaming = 1e-3;
  double none = 1;
  int count = 0;
  std::string tight;
  std::array<char, 200> text{};
  for (const Line& line : lines) {
    double noneHere = 1;
    for (const double rate : line.falseAlarms) noneHere *= 1 - rate;
    count += int(line.falseAlarms.size());
    none *= noneHere;
    if (1 - noneHere < kWorthNaming) continue;
    std::snprintf(text.data(), text.size(), "%s%s %.2g", tight.empty() ? "" : ", ",
                  line.asked->id.c_str(), 1 - noneHere);
    tight += text.data();
  }
  if (count == 0) return "";
  std::snprintf(text.data(), text.size(),
                "%d means over seeds; with other seeds one or more fail by chance in %.2g of all "
                "runs",
                count, 1 - none);
  return text.data() + (tight.empty() ? "" : "; by case: " + tight) + "\n";
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
