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
// 2 pi d exp(-pi d^2), so pi d^2 is distributed exponentially.
double MeanOverlap(double inDisk, double inReach) {
  constexpr int kDistances = 1000;
  constexpr double kFarthest = 30;  // exp(-30) is negligible
  const double disk = std::sqrt(inDisk / std::numbers::pi);
  const double farthest = std::sqrt(std::min(inReach, kFarthest) / std::numbers::pi);
  double sum = 0, total = 0;
  for (int i = 0; i < kDistances; ++i) {
    const double d = farthest * (i + .5) / kDistances;
    const double density = d * std::exp(-std::numbers::pi * d * d);
    sum += density * OverlapArea(d, disk);
    total += density;
  }
  return std::clamp(sum / total, 0., 1.);
}

}  // namespace

OwnPhotonWeight::OwnPhotonWeight(double share, double photonsInReach) : share_(share) {
  perPhoton_[0] = .5;  // half of a small disk lies in the circle
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const double step = double(i) / double(kSteps), inDisk = step * step * kMostInDisk;
    perPhoton_[i] = MeanOverlap(inDisk, share * photonsInReach) / inDisk;
  }
}

double OwnPhotonWeight::In(double photonsInDisk) const {
  if (!(share_ > 0)) return 1;
  const double inDisk = std::clamp(share_ * photonsInDisk, 0., kMostInDisk);
  const double at = std::sqrt(inDisk / kMostInDisk) * double(kSteps);
  const std::size_t i = std::min(std::size_t(at), kSteps - 1);
  const double perPhoton = perPhoton_[i] + (at - double(i)) * (perPhoton_[i + 1] - perPhoton_[i]);
  return std::min(inDisk * perPhoton, 1.);
}

}  // namespace exphoton
