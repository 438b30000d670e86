// SPDX-License-Identifier: BSD-2-Clause
// MakeReport makes the HTML page of a study.
#pragma once

#include <string>

#include "core/app/analysis/analysis.h"

namespace exphoton::study {

// Returns the text of report.html, which is self-contained: no network access and no scripts.
std::string MakeReport(const std::string& folder, const Results& results, const Analysis& analysis);

}  // namespace exphoton::study
