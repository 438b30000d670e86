// SPDX-License-Identifier: BSD-2-Clause
// OwnPhotonWeight: a table of the mean overlap of the empty circle and the disk.
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

// The unit of area holds one radiance photon. The distance d of the nearest one has the density
// 2 pi d exp(-pi d^2).
double DensityOfNearest(double d) {
  return 2 * std::numbers::pi * d * std::exp(-std::numbers::pi * d * d);
}

}  // namespace

OwnPhotonWeight::OwnPhotonWeight(double share, double reach)
    : share_(share), reach2_(reach * reach) {
  constexpr std::size_t kDistances = 32;  // in a step of the reach
  const double farthest = std::sqrt(kMost / std::numbers::pi);
  const double width = farthest / double(kSteps * kDistances);
  for (std::size_t i = 0; i <= kSteps; ++i) {
    const double step = double(i) / double(kSteps), inDisk = step * step * kMost;
    const double disk = step * farthest;
    double sum = 0;
    for (std::size_t n = 0; n < kSteps * kDistances; ++n) {
      const double d = (double(n) + .5) * width;
      // Half of a very small disk lies in the circle.
      const double overlap = inDisk > 0 ? OverlapArea(d, disk) / inDisk : .5;
      sum += DensityOfNearest(d) * overlap * width;
      if ((n + 1) % kDistances == 0) taken_[i][(n + 1) / kDistances] = sum;
    }
  }
}

double OwnPhotonWeight::TakenShare(double inDisk, double inReach) const {
  const double row = std::sqrt(std::clamp(inDisk / kMost, 0., 1.)) * double(kSteps);
  const double column = std::sqrt(std::clamp(inReach / kMost, 0., 1.)) * double(kSteps);
  const std::size_t i = std::min(std::size_t(row), kSteps - 1);
  const std::size_t j = std::min(std::size_t(column), kSteps - 1);
  const double below = std::lerp(taken_[i][j], taken_[i][j + 1], column - double(j));
  const double above = std::lerp(taken_[i + 1][j], taken_[i + 1][j + 1], column - double(j));
  return std::lerp(below, above, row - double(i));
}

// A hit finds no radiance photon with the probability exp(-inReach). Its estimate then lacks the
// radiance photons of the disk, as far as this lies within reach. Both losses are divided among the
// hits that find one.
double OwnPhotonWeight::In(double photonsInDisk, double photonsInReach) const {
  if (!(share_ > 0)) return 1;
  const double inDisk = std::clamp(share_ * photonsInDisk, 0., kMost);
  const double inReach = std::max(share_ * photonsInReach, 0.), found = -std::expm1(-inReach);
  if (!(found > 0)) return 1;
  const double lost = TakenShare(inDisk, inReach) + (1 - found) * std::min(reach2_, 1.);
  return std::min(inDisk * lost / found, 1.);
}

}  // namespace exphoton
