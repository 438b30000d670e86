// SPDX-License-Identifier: BSD-2-Clause
// The chart of error against seconds, both logarithmic: one line for each label.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// An <svg> element. Points on the Pareto front of all settings carry the numbers 1, 2 ... of
// FrontOf.
std::string CostChart(const Results& results, const Analysis& analysis);

// Indices of Analysis::settings on the front of all, by rising seconds.
std::vector<std::size_t> FrontOf(const Analysis& analysis);

}  // namespace exphoton::study
