// SPDX-License-Identifier: BSD-2-Clause
// OwnPhotonWeight is the weight of the photon at which a radiance photon lies. This photon is
// always in the disk of the estimate, so a full weight makes the estimate too bright. But a gather
// ray reads the nearest radiance photon, so the circle about its hit that ends at this one holds no
// other. Where the circle lies in the disk, photons are missing. With this weight, both effects
// cancel (docs/theory/exphotonmap.md, section 4).
#pragma once

#include <array>

namespace exphoton {

class OwnPhotonWeight {
 public:
  OwnPhotonWeight() = default;  // no radiance photons: a photon counts as it is
  // Radiance photons are a share of all photons, of all maps, and are scattered with constant
  // density. A disk with `photonsInReach` photons is the one within which rays read a radiance
  // photon.
  OwnPhotonWeight(double share, double photonsInReach);

  // Returns the weight in [0,1], good to 1 %, in a disk that holds this mean number of photons.
  double In(double photonsInDisk) const;

 private:
  static constexpr std::size_t kSteps = 32;
  static constexpr double kMostInDisk = 16;  // radiance photons; the weight hardly grows beyond

  double share_ = 0;
  // Weight divided by the radiance photons in the disk, by the root of their number
  std::array<double, kSteps + 1> perPhoton_{};
};

}  // namespace exphoton
