// SPDX-License-Identifier: BSD-2-Clause
// Prediction is the quote of an integrator: the CPU time in which it is expected to reach an error,
// made from pilots before the study's renders. Comparisons put quotes beside measurements.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace exphoton::study {

struct Results;
struct Analysis;

struct Prediction {
  // The cheapest setting that is expected to reach an error.
  struct Point {
    double error = 0;                         // relMSE, > 0
    double seconds = 0, least = 0, most = 0;  // CPU time, with a 90 % interval; most may be inf
  };
  std::string integrator;
  std::string failure;        // why there is no quote; "": there is one
  std::vector<Point> points;  // by falling error

  // Interpolates log seconds over log error. Returns nullopt beyond the points.
  std::optional<Point> At(double error) const;
};

// The quote for the error of a measured setting.
struct PredictionCheck {
  std::size_t setting = 0;  // index of Analysis::settings
  Prediction::Point expected;
  double measured = 0;  // CPU seconds

  double Ratio() const { return measured / expected.seconds; }
  bool IsInside() const { return measured >= expected.least && measured <= expected.most; }
};
// Returns the checks of the settings on the front of each integrator's own line, line by line.
// Errors that include no bias (without a reference) cannot be checked.
std::vector<PredictionCheck> CheckPredictions(const Results& results, const Analysis& analysis);

// Returns the prediction of a line of the charts, or null. A line whose label is not the name of an
// integrator has none.
const Prediction* PredictionOf(const Results& results, const std::string& label);

}  // namespace exphoton::study
