// SPDX-License-Identifier: BSD-2-Clause
// OwnPhotonWeight: the mean overlap of the empty circle and the disk, by the midpoint rule.
#include "integrators/photon/maps/own_photon_weight.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace exphoton {
namespace {

// Returns the area of the part of a circle that subtends an angle of 2 a, beyond the chord.
double SegmentArea(double radius, double a) { return radius * radius * (a - std::sin(2 * a) / 2); }

// Returns the area that a circle of radius d has in common with a disk whose centre is on its rim.
double OverlapArea(double d, double disk) {
  if (disk >= 2 * d) return std::numbers::pi * d * d;
  const double ofDisk = std::acos(std::clamp(disk / (2 * d), 0., 1.));
  return SegmentArea(d, std::numbers::pi - 2 * ofDisk) + SegmentArea(disk, ofDisk);
}

}  // namespace

// The unit of area holds one radiance photon. The distance d of the nearest one has the density
// 2 pi d exp(-pi d^2), so pi d^2 is distributed exponentially.
double OwnPhotonWeight(double inDisk, double inReach) {
  constexpr int kSteps = 1000;
  constexpr double kFarthest = 30;  // exp(-30) is negligible
  const double disk = std::sqrt(inDisk / std::numbers::pi);
  const double farthest = std::sqrt(std::min(inReach, kFarthest) / std::numbers::pi);
  double sum = 0, total = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double d = farthest * (i + .5) / kSteps;
    const double density = d * std::exp(-std::numbers::pi * d * d);
    sum += density * OverlapArea(d, disk);
    total += density;
  }
  return std::clamp(sum / total, 0., 1.);
}

}  // namespace exphoton
