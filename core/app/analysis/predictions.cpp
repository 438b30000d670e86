// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/analysis/predictions.h"

#include <algorithm>
#include <cmath>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {
namespace {

double Between(double a, double b, double t) { return a * std::pow(b / a, t); }

}  // namespace

std::optional<Prediction::Point> Prediction::At(double error) const {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    if (error > a.error || error < b.error) continue;
    const double t = std::log(error / a.error) / std::log(b.error / a.error);
    return Point{error, Between(a.seconds, b.seconds, t), Between(a.least, b.least, t),
                 Between(a.most, b.most, t)};
  }
  return std::nullopt;
}

const Prediction* PredictionOf(const Results& results, const std::string& label) {
  const auto found = std::ranges::find(results.predictions, label, &Prediction::integrator);
  return found != results.predictions.end() && found->failure.empty() ? &*found : nullptr;
}

std::vector<PredictionCheck> CheckPredictions(const Results& results, const Analysis& analysis) {
  std::vector<PredictionCheck> checks;
  if (!analysis.hasReference) return checks;
  for (const Line& line : analysis.lines) {
    const Prediction* const prediction = PredictionOf(results, line.label);
    if (!prediction) continue;
    for (const std::size_t i : analysis.Front(line.settings)) {
      const SettingResult& setting = analysis.settings[i];
      if (const auto expected = prediction->At(setting.cost.error.value))
        checks.push_back({i, *expected, setting.cpu.value});
    }
  }
  return checks;
}

}  // namespace exphoton::study
