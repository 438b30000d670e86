// SPDX-License-Identifier: BSD-2-Clause
// SharingShares weighs fits against the own light of fragments. A fit has little noise and some
// bias, own light has noise alone. Let d be own light minus fit, with the variance V and the mean
// b, the bias. The mean square of the error is least where the fit has the share V / (V + b^2), if
// the noise of the fit is small. This is the rule of James and Stein 1961, "Estimation with
// Quadratic Loss", which Gu et al. 2022, "Neural James-Stein Combiner for Unbiased and Biased
// Renderings", apply to pictures. V and b^2 are estimated from the groups of samples in a
// neighbourhood of each place of a PlaceGrid.
#pragma once

#include "core/base/parallel.h"
#include "core/render/sharing/windows/fragment_fits.h"
#include "core/render/sharing/windows/place_grid.h"

namespace exphoton {

class SharingShares {
 public:
  // A share depends on the fits of the fragments within this number of pixels, also for a pixel
  // that is one pixel farther away.
  static constexpr int kReach = 6 + 6 + 1;

  // The fits must reach kReach pixels beyond the pixels whose shares are wanted.
  SharingShares(const FragmentFits::Source& source, const FragmentFits& fits, ThreadPool* threads);

  // Returns the share of the fit in the light of a fragment, in [0,1].
  Real At(Point2i pixel, const FitTarget& target, FitNeighbours* scratch) const;

 private:
  struct Place : PlaceSpot {
    explicit Place(const PlaceSpot& spot) : PlaceSpot(spot) {}
    Real share = 1;
  };
  PlaceGrid<Place> grid_;
};

}  // namespace exphoton
