// SPDX-License-Identifier: BSD-2-Clause
// FragmentFits has the fits of all fragments of a region, each within its window.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/base/parallel.h"
#include "core/render/sharing/windows/window_fit.h"

namespace exphoton {

struct FragmentFit {
  std::optional<LocalFit> fit;  // to all records; nullopt: the fragment keeps its own light
  SharingWindows::Window window{};
  std::optional<Spectrum> checked;  // WindowFit::Difference of the group that GroupOf returns
};

class FragmentFits {
 public:
  // Returns the group of a pixel that is checked; nullopt: none. May be empty. Different threads
  // may call it at once.
  using GroupOf = std::function<std::optional<int>(Point2i)>;

  // The rows must have the fragments of `gathers`, and must outlive this object. Fragments beyond
  // the region have no fit.
  struct Source {
    const GatherFragments& gathers;
    const FragmentRows& rows;
    const SharingWindows& windows;
  };
  FragmentFits(const Source& source, const PixelBounds& region, const GroupOf& groupOf,
               ThreadPool* threads);

  // Returns the fits of a pixel's fragments, from the first one on.
  const FragmentFit* At(Point2i pixel) const { return &fits_[rows_.First(pixel)]; }

 private:
  const FragmentRows& rows_;
  std::vector<FragmentFit> fits_;  // by index in the rows
};

}  // namespace exphoton
