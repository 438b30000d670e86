// SPDX-License-Identifier: BSD-2-Clause
// SharingChoice says how far gathers are shared, and how much of the light is shared.
#pragma once

#include "core/render/sharing/windows/fragment_fits.h"
#include "core/render/sharing/windows/sharing_shares.h"
#include "core/render/sharing/windows/sharing_windows.h"

namespace exphoton {

class SharingChoice {
 public:
  // For the pixels of `window`, and one pixel beyond. `windowArea` is the area of the windows,
  // relative to those that cross-validation chooses. The rows must outlive this object.
  struct Request {
    PixelBounds window;
    double windowArea = 1;
    FragmentFits::GroupOf groupOf{};  // of the fits in the window; empty: none is checked
  };
  SharingChoice(const GatherFragments& gathers, const FragmentRows& rows, const Request& request,
                ThreadPool* threads);
  SharingChoice(const SharingChoice&) = delete;
  SharingChoice& operator=(const SharingChoice&) = delete;

  const SharingWindows& Windows() const { return windows_; }
  const FragmentFits& Fits() const { return fits_; }
  // Returns the share of the fit in the light of a fragment. A window that shrinks below the
  // smallest fit ends sharing, whatever the share of that fit is, so both are multiplied.
  Real ShareOf(Point2i pixel, const FitTarget& target, const SharingWindows::Window& window,
               FitNeighbours* scratch) const {
    return window.share > 0 ? window.share * shares_.At(pixel, target, scratch) : 0;
  }

 private:
  SharingWindows windows_;
  FragmentFits fits_;
  SharingShares shares_;
};

}  // namespace exphoton
