// SPDX-License-Identifier: BSD-2-Clause
// QuoteText prints the prices of all integrators, with the commands that render so.
#pragma once

#include <string>
#include <vector>

#include "core/app/quote/pilot_renders.h"

namespace exphoton::cli {

// accuracies: relative, .05 for 5 %.
std::string QuoteText(const QuoteScene& scene, const std::vector<Quote>& quotes,
                      const std::vector<double>& accuracies);

}  // namespace exphoton::cli
