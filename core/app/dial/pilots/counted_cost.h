// SPDX-License-Identifier: BSD-2-Clause
// CountedCost is the cost of a render in units of one ray of a path tracer. It follows from counted
// rays and photons and not from a clock, so that choices based on it are the same on all machines.
#pragma once

#include <string>

#include "core/base/statistics.h"

namespace exphoton::cli {

struct CountedCost {
  double maps = 0;         // shooting photons and building the maps
  double samples = 0;      // rendering
  double causticMaps = 0;  // about the part of `maps` that is for the caustic map alone
  double directMaps = 0;   // the same for the direct map, with the first rays of its paths
};
CountedCost CostOf(const Statistics& statistics, const std::string& integrator);

// How much more a ray costs that estimates the bias (--certify) than the integrator's other rays.
constexpr double kCorrectionRay = 2.3;

// Returns the number of photons that the statistics count, in all maps.
double StoredPhotons(const Statistics& statistics);
double CounterOf(const Statistics& statistics, const std::string& name);  // 0: no such counter

// PilotWork adds up what the small renders of --accuracy traced and stored.
struct PilotWork {
  int renders = 0;
  RayCounters rays;
  double direct = 0, caustic = 0, indirect = 0;  // photons that were stored
  // Whether the first groups of passes of the picture, or of its last attempt, have photons of the
  // last pilot.
  bool givesPhotons = false;

  void Add(const Statistics& statistics);
  void Add(const PilotWork& other);  // but not givesPhotons
};

}  // namespace exphoton::cli
