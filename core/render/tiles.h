// SPDX-License-Identifier: BSD-2-Clause
// Tiles divides a render into pieces of work. The picture does not depend on them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "core/render/render.h"

namespace exphoton {

// The crop window, divided into squares that are numbered in rendering order.
class Tiles {
 public:
  Tiles(const PixelBounds& crop, const RenderOptions& options)
      : crop_(crop), size_(std::max(options.tileSize, 1)), order_(options.tileOrder) {
    columns_ = (std::int64_t(crop.Width()) + size_ - 1) / size_;
    rows_ = (std::int64_t(crop.Height()) + size_ - 1) / size_;
    if (order_ == TileOrder::Scattered) stride_ = StrideOf(Count());
  }
  std::int64_t Count() const { return columns_ * rows_; }
  PixelBounds Get(std::int64_t number) const {
    if (order_ == TileOrder::Reversed) number = Count() - 1 - number;
    if (order_ == TileOrder::Scattered) number = number * stride_ % Count();
    const std::int64_t x = crop_.x0 + number % columns_ * size_;
    const std::int64_t y = crop_.y0 + number / columns_ * size_;
    return {int(x), int(y), int(std::min<std::int64_t>(x + size_, crop_.x1)),
            int(std::min<std::int64_t>(y + size_, crop_.y1))};
  }

 private:
  // Returns the step between successive tiles: about the golden section of the count, so that any
  // number of successive tiles is spread evenly, and without a common divisor, so that all are met.
  static std::int64_t StrideOf(std::int64_t count) {
    auto stride = std::max<std::int64_t>(std::int64_t(double(count) * .6180339887498949), 1);
    while (std::gcd(stride, count) > 1) ++stride;
    return stride;
  }

  PixelBounds crop_;
  std::int64_t size_, columns_, rows_;
  TileOrder order_;
  std::int64_t stride_ = 1;
};

}  // namespace exphoton
