// SPDX-License-Identifier: BSD-2-Clause
// FindContenders and ChooseTarget choose the integrators and the error of a study's headline.
#pragma once

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Returns round errors in descending order: 1, 0.5, 0.3, 0.2, 0.1 and so on.
std::vector<double> RoundErrors();

std::vector<Contender> FindContenders(const Analysis& analysis);

// Returns an error that shows who is the fastest, if there is one: the time of a contender is only
// a bound if even its cheapest picture is better. Of several it takes the one for which most
// contenders have a time, then the one for which most times are exact, and of these the smallest.
// Only errors count that give at least one ratio of times, that the reference can measure, and,
// where possible, that are round and useful.
std::optional<double> ChooseTarget(const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
