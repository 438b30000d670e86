// SPDX-License-Identifier: BSD-2-Clause
// Figures are results of functions that no scene and no command records, mostly because programs
// call them with times: prices, plans of passes, statistics of studies, and texts for people.
#pragma once

#include <string>
#include <vector>

namespace exphoton::recorded {

// Returns all of them, a line each: a name and numbers or texts.
std::vector<std::string> Figures();

// The groups, each with its own file of sources.
std::vector<std::string> PriceFigures();  // quotes and plans of passes
std::vector<std::string> StudyFigures();  // curves, texts, pictures and their differences
std::vector<std::string> PieceFigures();  // parts of pictures, names, tails of distributions

// Lines collects lines of a name and its values.
class FigureLines {
 public:
  template <class... Values>
  void Add(std::string name, const Values&... values) {
    (..., (name += " " + Text(values)));
    lines_.push_back(std::move(name));
  }
  std::vector<std::string> Take() { return std::move(lines_); }

 private:
  static std::string Text(double value);
  static std::string Text(const std::string& text) { return text; }
  static std::string Text(const char* text) { return text; }

  std::vector<std::string> lines_;
};

}  // namespace exphoton::recorded
