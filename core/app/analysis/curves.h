// SPDX-License-Identifier: BSD-2-Clause
// CostPoint is a measured pair (seconds, error). The functions here find the Pareto front of such
// points, the time to reach an error, and the effect of doubling a parameter.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/plan.h"
#include "core/app/analysis/separation.h"

namespace exphoton::study {

struct CostPoint {
  Measured seconds, error;
};

// Returns the indices of the points that no other point beats in both seconds and error, in order
// of increasing seconds. Ignores points without a positive finite error and time.
std::vector<std::size_t> ParetoFront(const std::vector<CostPoint>& points);

// TimeToError is the time to reach an error. It is interpolated between two points of the Pareto
// front, linearly in log-log, and never extrapolated.
struct TimeToError {
  enum class Kind {
    Reached,  // `seconds` is the time to the error
    AtMost,   // the cheapest point has a smaller error; `seconds` is its time
    Never,    // all points have a larger error
  };
  Kind kind = Kind::Never;
  Measured seconds;  // standard error by first-order propagation
  CostPoint best;    // the point with the smallest error
};
TimeToError FindTimeToError(const std::vector<CostPoint>& points, double error);

// Returns a / b with its standard error to first order.
Measured Ratio(const Measured& a, const Measured& b);

// DoublingEffect is the effect of doubling a numeric parameter. It is averaged over neighbouring
// pairs of settings that differ only in that parameter. The standard errors are those of the
// settings, propagated to first order; the pairs may differ by more.
struct DoublingEffect {
  std::string label, parameter;
  Measured secondsPerDoubling;
  Measured errorFactor;  // factor on the error per doubling (geometric mean)
  int pairs = 0;
};
std::vector<DoublingEffect> FindDoublingEffects(const std::vector<Setting>& settings,
                                                const std::vector<CostPoint>& points);

}  // namespace exphoton::study
