// SPDX-License-Identifier: BSD-2-Clause
// The page of a study and the sentence that sums it up.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// report.html: everything inside, no network, no script.
std::string MakeReport(const std::string& folder, const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
