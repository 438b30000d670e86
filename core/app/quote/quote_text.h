// SPDX-License-Identifier: BSD-2-Clause
// QuoteText prints the prices of all integrators, with the commands that render so.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/app/quote/quote_pilots.h"

namespace exphoton::cli {

// What the commands render.
struct QuoteScene {
  std::string path;
  // Of the renders of each integrator, such as --set and --resolution.
  std::map<std::string, std::vector<std::string>> options = {};
  const Sampler* sampler = nullptr;  // as in Order
};

// accuracies: relative, .05 for 5 %.
std::string QuoteText(const QuoteScene& scene, const std::vector<Quote>& quotes,
                      const std::vector<double>& accuracies);

}  // namespace exphoton::cli
