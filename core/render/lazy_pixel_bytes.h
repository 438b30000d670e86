// SPDX-License-Identifier: BSD-2-Clause
// LazyPixelBytes holds one byte for each pixel of a window, computed when it is first asked for.
// Several threads may ask at once. The byte must be a function of the pixel alone, so it does not
// matter which thread computes it.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/imaging/image.h"
#include "core/math/vec.h"

namespace exphoton {

class LazyPixelBytes {
 public:
  static constexpr int kMost = 254;

  explicit LazyPixelBytes(const PixelBounds& window)
      : window_(window), values_(std::size_t(window.Width()) * std::size_t(window.Height())) {}

  // The pixel must lie in the window. compute(pixel) returns its byte, an int of at least 0.
  // Values above kMost count as kMost.
  template <class Compute>
  int At(Point2i pixel, const Compute& compute) {
    std::atomic<std::uint8_t>& value =
        values_[std::size_t(pixel.y - window_.y0) * std::size_t(window_.Width()) +
                std::size_t(pixel.x - window_.x0)];
    std::uint8_t afterUnknown = value.load(std::memory_order_relaxed);
    if (afterUnknown == 0) {
      afterUnknown = std::uint8_t(std::min(compute(pixel), kMost) + 1);
      value.store(afterUnknown, std::memory_order_relaxed);
    }
    return afterUnknown - 1;
  }

 private:
  PixelBounds window_;
  std::vector<std::atomic<std::uint8_t>> values_;  // plus 1; 0 is unknown
};

}  // namespace exphoton
