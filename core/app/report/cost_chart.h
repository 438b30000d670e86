// SPDX-License-Identifier: BSD-2-Clause
// CostChart draws error against seconds, both logarithmic, with one line per label.
#pragma once

#include <vector>

#include "core/app/analysis/analysis.h"
#include "core/app/report/template.h"

namespace exphoton::study {

// Returns an <svg> element. The points on the Pareto front of all settings are numbered 1, 2 and so
// on, in the order of FrontOf.
Html CostChart(const Results& results, const Analysis& analysis);

// Returns the indices of Analysis::settings on the Pareto front of all, by increasing seconds.
std::vector<std::size_t> FrontOf(const Analysis& analysis);

}  // namespace exphoton::study
