// SPDX-License-Identifier: BSD-2-Clause
// A radiance photon lies at a photon of a map. This photon is always in the disk of its estimate,
// so a full weight makes the estimate too bright. But a gather ray reads the nearest radiance
// photon, so the circle about its hit that ends at this one holds no other. Where the circle lies
// in the disk, photons are missing. OwnPhotonWeight has the weight of the own photon with which
// both effects cancel (docs/theory/exphotonmap.md, section 4).
#pragma once

#include <array>

namespace exphoton {

class OwnPhotonWeight {
 public:
  OwnPhotonWeight() { weights_.fill(1); }  // no radiance photons: a photon counts as it is
  // Radiance photons are a share of all photons, scattered with constant density. A disk with
  // `photonsInReach` photons is the one within which rays read a radiance photon.
  OwnPhotonWeight(double share, double photonsInReach);

  // Returns the weight in [0,1], good to .01, in a disk that holds this mean number of photons.
  double In(double photonsInDisk) const;

 private:
  static constexpr std::size_t kSteps = 32;
  static constexpr double kMostInDisk = 16;  // radiance photons; the weight hardly grows beyond

  double share_ = 0;
  std::array<double, kSteps + 1> weights_{};  // by the root of the radiance photons in the disk
};

}  // namespace exphoton
