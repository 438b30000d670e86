// SPDX-License-Identifier: BSD-2-Clause
// WindowFit fits light around a fragment within its window.
#pragma once

#include <optional>

#include "core/render/sharing/windows/sharing_windows.h"

namespace exphoton {

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
  // Returns the fit to a group minus the own light of this group; 0 if the fragment keeps its own.
  Spectrum Difference(int group) const;

 private:
  // Returns whether a fragment is a detail that its window does not resolve, such as a line of
  // single pixels: all groups of its records differ from the fit beyond their noise, in the same
  // direction, and so do the choosing groups from each other's fits. A single bright record is in
  // one group, so it makes no detail, neither here nor in neighbours whose fits it raises.
  bool IsDetail(const Spectrum& fit) const;

  const GatherFragment& fragment_;
  FitTarget target_;
  SharingWindows::Window window_;
  const FitNeighbours& neighbours_;
};

}  // namespace exphoton
