// SPDX-License-Identifier: BSD-2-Clause
// This file makes the section that puts quotes beside measurements.
#include <algorithm>
#include <cmath>

#include "core/app/analysis/numbers.h"
#include "core/app/analysis/predictions.h"
#include "core/app/report/page_sections.h"
#include "core/app/report/page_tables.h"

namespace exphoton::study {
namespace {

constexpr double kNear = 1.5;  // factor

std::string IntervalText(const Prediction::Point& expected) {
  return SecondsText(expected.least) + " to " +
         (std::isfinite(expected.most) ? SecondsText(expected.most) : "no known end");
}

std::string SummaryText(const std::vector<PredictionCheck>& checks) {
  const auto inside = std::ranges::count_if(checks, &PredictionCheck::IsInside);
  const auto near = std::ranges::count_if(checks, [](const PredictionCheck& check) {
    return std::abs(std::log(check.Ratio())) <= std::log(kNear);
  });
  if (checks.empty()) return "no setting can be compared";
  const std::string all = std::to_string(checks.size());
  return std::to_string(inside) + " of " + all + " times lie inside the interval, " +
         std::to_string(near) + " of " + all + " within a factor of " + ShortNumber(kNear);
}

Html CheckRow(const Analysis& analysis, const PredictionCheck& check,
              const ParameterColumns& columns) {
  const SettingResult& setting = analysis.settings[check.setting];
  return Fill("prediction-row", {{"line", LineCell(analysis, check.setting)},
                                 {"parameters", columns.Cells(setting)},
                                 {"error", ThousandthsCell(setting.cost.error)},
                                 {"measured", SecondsText(check.measured)},
                                 {"expected", SecondsText(check.expected.seconds)},
                                 {"interval", IntervalText(check.expected)},
                                 {"ratio", ShortNumber(check.Ratio())}});
}

}  // namespace

Html PredictionSection(const Results& results, const Analysis& analysis) {
  if (results.predictions.empty()) return {};
  const std::vector<PredictionCheck> checks = CheckPredictions(results, analysis);
  std::vector<std::size_t> shown;
  for (const PredictionCheck& check : checks) shown.push_back(check.setting);
  const ParameterColumns columns(results, analysis, shown);
  Html rows;
  for (const PredictionCheck& check : checks) rows += CheckRow(analysis, check, columns);
  for (const Prediction& prediction : results.predictions)
    if (!prediction.failure.empty())
      rows += Fill("price-note",
                   {{"columns", 6 + columns.Count()},
                    {"text", prediction.integrator + " has no quote: " + prediction.failure}});
  return Fill("prediction-section",
              {{"summary", SummaryText(checks)}, {"parameters", columns.Heads()}, {"rows", rows}});
}

}  // namespace exphoton::study
