// SPDX-License-Identifier: BSD-2-Clause
// SharingWindows chooses how far gathers are shared, by cross-validation: light that is fitted to
// the gathers of one choosing group of samples is compared with light of the other one. The mean
// squared difference is the error of the fit, bias included, plus noise that is the same for all
// windows. Windows are chosen on a PlaceGrid.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/local_fit.h"
#include "core/render/sharing/windows/place_grid.h"

namespace exphoton {

class SharingWindows {
 public:
  // Radii of fits, in pixels. Radius 0 means that gathers are not shared.
  static constexpr std::array<Real, 6> kRadii{0, 2, 3, 4, 6, 9};
  static constexpr Real kMaxRadius = 9;
  // A window depends on the gathers within this number of pixels.
  static constexpr int kReach = 9 + 12 + 6;

  SharingWindows(const GatherFragments& gathers, const FragmentRows& rows, ThreadPool* threads);

  // The radius of a fit in pixels, and the largest share of the fit in the light, which
  // SharingShares lowers. The rest is the sample's own light. The largest share is 1 except where
  // windows are smaller than the smallest fit. `noise` is the variance of the light of one record
  // around fits nearby, relative to the square of a smooth fit; 0: not known.
  struct Window {
    Real radius, share, noise;
  };
  Window At(Point2i pixel, const FitTarget& target, FitNeighbours* scratch) const;

  // Makes the area of all windows smaller than the chosen one by this factor in (0,1].
  void Shrink(double area) { scale_ = Real(std::sqrt(area)); }

 private:
  using Errors = std::array<std::array<float, kRadii.size()>, 2>;
  struct Place : PlaceSpot {
    explicit Place(const PlaceSpot& spot) : PlaceSpot(spot) {}
    // Squared relative differences between the fit of each window and the other group's own light,
    // and its fit with the smallest window; by group of the fit.
    Errors errors{}, errorsOfFits{};
    // The records in the own light that `errors` compare with, by group of the fit.
    std::array<Real, 2> otherRecords{};
    bool isJudged = false;
    Real radius = 0, noise = 0;  // as in Window
  };

  struct Nearby {  // a judged place on the surface of another one
    const Place* place;
    Real weight;
  };
  struct Scratch {
    FitNeighbours neighbours;
    std::vector<Nearby> nearby;
  };
  // Fills errors. `fragment` is the one of the place.
  static void Judge(const FragmentRows& rows, const GatherFragment& fragment, Place* place,
                    FitNeighbours* scratch);
  // Fills radius and noise, which do not depend on those of other places.
  void Choose(Place* place, Scratch* scratch) const;
  // Returns the noise of Window for fits of this window, from the places nearby.
  static Real NoiseAround(const std::vector<Nearby>& nearby, std::size_t window);

  PlaceGrid<Place> grid_;
  Real scale_ = 1;  // of the radii
};

}  // namespace exphoton
