// SPDX-License-Identifier: BSD-2-Clause
// What points of (seconds, error) say: which are worth their price, how long a given error takes,
// and what one step of a parameter costs.
#pragma once

#include <string>
#include <vector>

#include "core/app/analysis/plan.h"
#include "core/app/analysis/separation.h"

namespace exphoton::study {

struct CostPoint {
  Measured seconds, error;
};

// Indices of the points that no other point beats in both seconds and error, by rising seconds.
// Points without a positive finite error or time are left out.
std::vector<std::size_t> ParetoFront(const std::vector<CostPoint>& points);

// Seconds to reach an error: between two points of the Pareto front on a straight line in log-log;
// never extrapolated.
struct TimeToError {
  enum class Kind {
    Reached,  // seconds
    AtMost,   // even the cheapest point has less error: its seconds
    Never,    // no point has so little error
  };
  Kind kind = Kind::Never;
  Measured seconds;  // standard error from those of the two points, to first order
  CostPoint best;    // of all points, the one with the least error
};
TimeToError FindTimeToError(const std::vector<CostPoint>& points, double error);

// a / b with its standard error to first order.
Measured Ratio(const Measured& a, const Measured& b);

// What doubling a numeric parameter does, among points that differ in nothing else, averaged over
// neighbouring pairs.
struct KnobCost {
  std::string label, parameter;
  double secondsPerDoubling = 0;
  double errorFactor = 1;  // of the error, by one doubling (geometric mean)
  int pairs = 0;
};
std::vector<KnobCost> FindKnobCosts(const std::vector<Setting>& settings,
                                    const std::vector<CostPoint>& points);

}  // namespace exphoton::study
