// SPDX-License-Identifier: BSD-2-Clause
// MissingLight compares the pilots of integrators. One that finds less light than another is
// biased, or rarely finds bright paths. Then its noise is underestimated, and it has no price.
#pragma once

#include <span>
#include <string>

#include "core/app/quote/mean_light.h"

namespace exphoton::cli {

struct PilotMean {
  std::string integrator;
  MeanLight light;  // of the pilot's picture
};

// What shows that light is missing.
struct LightTest {
  double leastMissing = .02;  // share of the light
  // That noise alone explains it: what lies four standard errors from 0.
  double mostChance = 6.3e-5;
};

// Returns a phrase if the mean lies below another one by more than the test allows and noise
// explains; otherwise "". A brighter mean with much noise does not hide one with less.
std::string MissingLight(const PilotMean& mean, std::span<const PilotMean> all,
                         const LightTest& test = {});

}  // namespace exphoton::cli
