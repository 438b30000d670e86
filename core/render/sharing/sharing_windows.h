// SPDX-License-Identifier: BSD-2-Clause
// SharingWindows chooses how far gathers are shared, by cross-validation: light that is fitted to
// the gathers of one choosing group of samples is compared with light of the other one. The mean
// squared difference is the error of the fit, bias included, plus noise that is the same for all
// windows. Windows are chosen on a grid of every fourth pixel, which is anchored at pixel 0,0.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/render/sharing/fragment_rows.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/sharing/local_fit.h"

namespace exphoton {

class SharingWindows {
 public:
  // Radii of fits, in pixels. Radius 0 means that gathers are not shared.
  static constexpr std::array<Real, 6> kRadii{0, 2, 3, 4, 6, 9};
  static constexpr Real kMaxRadius = 9;
  static constexpr int kStride = 4;
  // A window depends on the gathers within this number of pixels.
  static constexpr int kReach = 9 + 12 + 6;

  SharingWindows(const GatherFragments& gathers, const FragmentRows& rows, ThreadPool* threads);

  // The radius of a fit in pixels, and the share of the fit in the light. The rest is the sample's
  // own light. The share is 1 except where windows are smaller than the smallest fit. `noise` is
  // the variance of the light of one record around fits nearby, relative to the square of a smooth
  // fit; 0: not known.
  struct Window {
    Real radius, share, noise;
  };
  Window At(Point2i pixel, const GatherFragment& fragment) const;

  // Makes the area of all windows smaller than the chosen one by this factor in (0,1].
  void Shrink(double area) { scale_ = Real(std::sqrt(area)); }

 private:
  using Errors = std::array<std::array<float, kRadii.size()>, 2>;
  struct Spot {  // of a fragment
    Spot(Point2i aPixel, const GatherFragment& fragment)
        : pixel(aPixel),
          film(fragment.film),
          p(fragment.p),
          ng(fragment.ng),
          depth(fragment.depth) {}
    Point2i pixel;
    Point2 film;
    Point3 p;
    Normal3 ng;
    int depth;
  };
  struct Place : Spot {  // a fragment of a grid pixel
    using Spot::Spot;
    // Squared relative differences between the fit of each window and the other group's own light,
    // and its fit with the smallest window; by group of the fit.
    Errors errors{}, errorsOfFits{};
    // The records in the own light that `errors` compare with, by group of the fit.
    std::array<Real, 2> otherRecords{};
    bool isJudged = false;
    Real radius = 0, noise = 0;  // as in Window
  };
  using Cell = std::vector<Place>;

  static Place Judge(const FragmentRows& rows, Point2i pixel, const GatherFragment& fragment,
                     FitNeighbours* scratch);
  struct Nearby {  // a judged place on the surface of another one
    const Place* place;
    Real weight;
  };
  // Fills radius and noise, which do not depend on those of other places.
  void Choose(Place* place, std::vector<Nearby>* scratch) const;
  // Returns the noise of Window for fits of this window, from the places nearby.
  static Real NoiseAround(const std::vector<Nearby>& nearby, std::size_t window);
  // Calls use(place, weight) for the judged places within `radius` pixels on the surface of a
  // spot.
  template <class Use>
  void ForNearby(const Spot& point, Real radius, const Use& use) const;

  int x0_, y0_, columns_, rows_;  // of the grid
  std::vector<Cell> cells_;
  Real scale_ = 1;  // of the radii
};

// WindowFit fits light around a fragment within its window.
class WindowFit {
 public:
  struct Place {
    Point2i pixel;
    const GatherFragment& fragment;
  };
  // Collects the neighbours. The arguments must outlive this object, and `scratch` belongs to it.
  WindowFit(const FragmentRows& rows, const SharingWindows& windows, const Place& place,
            FitNeighbours* scratch);

  const SharingWindows::Window& Window() const { return window_; }
  const FitTarget& Target() const { return target_; }
  // Returns the fit to one set of records, which is stated by its first column; nullopt if the
  // fragment keeps its own light.
  std::optional<LocalFit> To(FragmentRows::Column set) const;

 private:
  // Returns whether a fragment is a detail that its window does not resolve, such as a line of
  // single pixels: all groups of its records differ from the fit beyond their noise, in the same
  // direction, and so do the choosing groups from each other's fits. A single bright record is in
  // one group, so it makes no detail, neither here nor in neighbours whose fits it raises.
  bool IsDetail(const Spectrum& fit) const;

  const GatherFragment& fragment_;
  SharingWindows::Window window_;
  FitTarget target_;
  const FitNeighbours& neighbours_;
};

}  // namespace exphoton
