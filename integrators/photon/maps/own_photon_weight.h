// SPDX-License-Identifier: BSD-2-Clause
// OwnPhotonWeight is the weight of the photon at which a radiance photon lies. This photon is
// always in the disk of the estimate, so a full weight makes the estimate too bright. But a gather
// ray reads the nearest radiance photon, so the circle about its hit that ends at this one holds no
// other. Where the circle lies in the disk, photons are missing. And where a hit finds no radiance
// photon, the estimate at the hit itself lacks the photons that would be one. With this weight, the
// mean of what hits read is the true density (docs/theory/exphotonmap.md, section 4).
#pragma once

#include <array>

namespace exphoton {

class OwnPhotonWeight {
 public:
  OwnPhotonWeight() = default;  // no radiance photons: a photon counts as it is
  // Radiance photons are a share of all photons, of all maps, and are scattered with constant
  // density. Rays read one within `reach` times the radius of the estimate at a hit.
  OwnPhotonWeight(double share, double reach);

  // Returns the weight in [0,1], good to 1 %, in a disk that holds the first mean number of
  // photons, where rays read a radiance photon within a disk that holds the second one. Both are
  // without the photon itself.
  double In(double photonsInDisk, double photonsInReach) const;
  double Reach2() const { return reach2_; }

 private:
  static constexpr std::size_t kSteps = 32;
  static constexpr double kMost = 16;  // radiance photons; the weight hardly grows beyond

  // Returns the mean number of radiance photons that the empty circle takes from the disk, divided
  // by those in the disk. Hits without a radiance photon count as 0.
  double TakenShare(double inDisk, double inReach) const;

  double share_ = 0, reach2_ = 0;
  // TakenShare by the roots of the radiance photons in the disk and in reach.
  std::array<std::array<double, kSteps + 1>, kSteps + 1> taken_{};
};

}  // namespace exphoton
