// SPDX-License-Identifier: BSD-2-Clause
// summary.csv: one row a setting, with everything that the page says of it, for charts of one's
// own.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Empty fields where something is unknown; "x +-" columns are standard errors.
std::string SummaryCsv(const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
