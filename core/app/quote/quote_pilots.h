// SPDX-License-Identifier: BSD-2-Clause
// RunPilots makes a PriceModel of one integrator, in CPU seconds, from the pilots of --accuracy.
#pragma once

#include <string>
#include <vector>

#include "core/app/dial/pilots/pilot_series.h"
#include "core/app/quote/mean_light.h"

namespace exphoton::cli {

// What pilots found about one integrator.
struct Quote {
  std::string integrator;
  PriceModel model;
  MeanLight light;                      // of the last pilot
  double memory = 0;                    // bytes, of the picture that is quoted
  DialSettings settings;                // the photons of the scene
  std::vector<std::string> notCovered;  // by the estimate of the bias
  std::vector<std::string> messages;    // of the last pilot, as they would be printed
  std::string failure;                  // why there is no quote; "": there is one
};

// Renders pilots for about this CPU time, at least two. Throws LoadingStopped.
Quote RunPilots(PilotRenderer* renderer, const std::string& integrator, double cpuSeconds);

}  // namespace exphoton::cli
