// SPDX-License-Identifier: BSD-2-Clause
// SummaryCsv makes summary.csv: one row per setting with all measurements of the report, as data
// for custom charts.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Unknown values are empty fields. Columns "x +-" are standard errors.
std::string SummaryCsv(const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
