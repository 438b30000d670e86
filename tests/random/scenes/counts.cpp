// SPDX-License-Identifier: BSD-2-Clause
// SoakCounts reads and writes its text, and states bounds of Clopper and Pearson.
#include "tests/random/scenes/counts.h"

#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "tests/random/scenes/statistics.h"

namespace exphoton::random_scenes {

SoakCounts ParseCounts(const std::string& text) {
  SoakCounts counts;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string name, rest;
    Tally tally;
    words >> name;
    const bool isRight = number == 1
                             ? name == "next" && words >> counts.next
                             : words >> tally.scenes >> tally.failures && tally.scenes >= 0 &&
                                   tally.failures >= 0 && tally.failures <= tally.scenes;
    if (!isRight || words >> rest)
      throw std::runtime_error("line " + std::to_string(number) + " of the counts is \"" + line +
                               "\"; expected \"next SEED\" first, then \"PROPERTY SCENES "
                               "FAILURES\"");
    if (number > 1) counts.tallies[name] = tally;
  }
  return counts;
}

std::string CountsText(const SoakCounts& counts) {
  std::string text = "next " + std::to_string(counts.next) + "\n";
  for (const auto& [property, tally] : counts.tallies)
    text +=
        property + " " + std::to_string(tally.scenes) + " " + std::to_string(tally.failures) + "\n";
  return text;
}

SoakCounts Sum(SoakCounts counts, const std::map<std::string, Tally>& run) {
  for (const auto& [property, tally] : run) {
    counts.tallies[property].scenes += tally.scenes;
    counts.tallies[property].failures += tally.failures;
  }
  return counts;
}

std::string TalliesText(const std::map<std::string, Tally>& tallies) {
  std::string text;
  for (const auto& [property, tally] : tallies) {
    char line[160];
    std::snprintf(line, sizeof line, "%s: %d scenes, %d failures; rate at most %.3g %% (95 %%)\n",
                  property.c_str(), tally.scenes, tally.failures,
                  100 * LargestFailureRate(tally.failures, tally.scenes));
    text += line;
  }
  return text;
}

}  // namespace exphoton::random_scenes
