// SPDX-License-Identifier: BSD-2-Clause
// This file makes the price list and the table of what doubling a parameter does.
#include <algorithm>

#include "core/app/analysis/headline/headline.h"
#include "core/app/analysis/numbers.h"
#include "core/app/report/markup.h"
#include "core/app/report/page_sections.h"
#include "core/app/report/page_tables.h"

namespace exphoton::study {
namespace {

std::size_t LineNumber(const Analysis& analysis, const std::string& label) {
  std::size_t i = 0;
  while (i + 1 < analysis.lines.size() && analysis.lines[i].label != label) ++i;
  return i;
}

// Returns each line's cheapest setting with at most the target error, in order of increasing
// seconds.
std::vector<std::size_t> CheapestOf(const Analysis& analysis, double target) {
  const auto seconds = [&](std::size_t i) { return analysis.settings[i].cost.seconds.value; };
  std::vector<std::size_t> all;
  for (const Line& line : analysis.lines) {
    std::vector<std::size_t> reached;
    for (const std::size_t i : line.settings)
      if (analysis.settings[i].cost.error.value <= target) reached.push_back(i);
    const auto best =
        std::min_element(reached.begin(), reached.end(),
                         [&](std::size_t a, std::size_t b) { return seconds(a) < seconds(b); });
    if (best != reached.end()) all.push_back(*best);
  }
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return seconds(a) < seconds(b); });
  return all;
}

Html PriceRow(const Analysis& analysis, std::size_t index, double least,
              const ParameterColumns& columns) {
  const SettingResult& s = analysis.settings[index];
  const double seconds = s.cost.seconds.value;
  const std::string text = SecondsText(seconds);
  return Fill("price-row",
              {{"line", LineCell(analysis, index)},
               {"seconds", seconds == least ? Fill("cheapest", {{"seconds", text}}) : Escape(text)},
               {"ratio", seconds == least ? "1×" : ShortNumber(seconds / least) + "×"},
               {"parameters", columns.Cells(s)},
               {"memory", ShortNumber(s.peakMemory / (1 << 20), 3)},
               {"photons", s.photonsStored > 0 ? CountText(s.photonsStored) : "–"}});
}

// Names the lines without a setting that is accurate enough.
Html MissingRow(const Analysis& analysis, const std::vector<std::size_t>& cheapest,
                std::size_t columns) {
  std::string names;
  for (std::size_t i = 0; i < analysis.lines.size(); ++i) {
    const bool isThere = std::any_of(cheapest.begin(), cheapest.end(), [&](std::size_t setting) {
      return LineOf(analysis, setting) == i;
    });
    if (!isThere) names += (names.empty() ? "" : ", ") + analysis.lines[i].label;
  }
  if (names.empty()) return {};
  return Fill("price-note", {{"columns", columns}, {"text", "none of the settings of " + names}});
}

}  // namespace

Html PriceSection(const Results& results, const Analysis& analysis) {
  constexpr std::size_t kOtherColumns = 5;
  std::vector<std::size_t> shown;
  for (const double target : results.targets)
    for (const std::size_t i : CheapestOf(analysis, target)) shown.push_back(i);
  const ParameterColumns columns(results, analysis, shown);
  const std::size_t count = kOtherColumns + columns.Count();
  Html rows;
  for (const double target : results.targets) {
    rows += Fill("price-group", {{"columns", count}, {"error", ShortNumber(target)}});
    const std::string shortfall = ShortfallText(analysis.reference, target);
    if (!shortfall.empty()) {
      rows += Fill("price-note", {{"columns", count}, {"text", "refused: " + shortfall}});
      continue;
    }
    const std::vector<std::size_t> cheapest = CheapestOf(analysis, target);
    for (const std::size_t i : cheapest)
      rows +=
          PriceRow(analysis, i, analysis.settings[cheapest.front()].cost.seconds.value, columns);
    rows += MissingRow(analysis, cheapest, count);
  }
  return Fill("price-section", {{"parameters", columns.Heads()}, {"rows", rows}});
}

Html DoublingSection(const Results& results, const Analysis& analysis) {
  std::vector<CostPoint> points(results.settings.size());
  for (const SettingResult& s : analysis.settings) points[s.setting] = s.cost;
  std::vector<DoublingEffect> costs = FindDoublingEffects(results.settings, points);
  if (costs.empty()) return {};
  std::stable_sort(costs.begin(), costs.end(),
                   [&](const DoublingEffect& a, const DoublingEffect& b) {
                     return LineNumber(analysis, a.label) < LineNumber(analysis, b.label);
                   });
  Html rows;
  for (const DoublingEffect& cost : costs)
    rows += Fill("doubling-row", {{"marker", LineMarker(LineNumber(analysis, cost.label))},
                                  {"label", cost.label},
                                  {"parameter", cost.parameter},
                                  {"seconds", SignedSecondsText(cost.secondsPerDoubling)},
                                  {"error", ChangeText(cost.errorFactor)},
                                  {"pairs", cost.pairs}});
  return Fill("doubling-section", {{"rows", rows}});
}

}  // namespace exphoton::study
