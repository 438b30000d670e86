// SPDX-License-Identifier: BSD-2-Clause
// Tiles divides a render into pieces of work. The picture does not depend on them.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/render/render.h"

namespace exphoton {

// The crop window, divided into squares that are numbered in rendering order.
class Tiles {
 public:
  Tiles(const PixelBounds& crop, const RenderOptions& options)
      : crop_(crop), size_(std::max(options.tileSize, 1)), order_(options.tileOrder) {
    columns_ = (std::int64_t(crop.Width()) + size_ - 1) / size_;
    rows_ = (std::int64_t(crop.Height()) + size_ - 1) / size_;
  }
  std::int64_t Count() const { return columns_ * rows_; }
  PixelBounds Get(std::int64_t number) const {
    if (order_ == TileOrder::Reversed) number = Count() - 1 - number;
    const std::int64_t x = crop_.x0 + number % columns_ * size_;
    const std::int64_t y = crop_.y0 + number / columns_ * size_;
    return {int(x), int(y), int(std::min<std::int64_t>(x + size_, crop_.x1)),
            int(std::min<std::int64_t>(y + size_, crop_.y1))};
  }

 private:
  PixelBounds crop_;
  std::int64_t size_, columns_, rows_;
  TileOrder order_;
};

}  // namespace exphoton
