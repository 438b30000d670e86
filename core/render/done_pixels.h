// SPDX-License-Identifier: BSD-2-Clause
// DonePixels records the pixels of a pass that have all their samples. Different threads may set
// different pixels at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/files/byte_archive.h"
#include "core/imaging/image.h"
#include "core/math/vec.h"

namespace exphoton {

class DonePixels {
 public:
  explicit DonePixels(const PixelBounds& window)
      : window_(window), done_(std::size_t(window.Width()) * std::size_t(window.Height())) {}

  const PixelBounds& Window() const { return window_; }
  bool Has(Point2i pixel) const { return done_[IndexOf(pixel)] != 0; }
  void Set(Point2i pixel) { done_[IndexOf(pixel)] = 1; }

  std::int64_t Total() const { return std::int64_t(done_.size()); }
  std::int64_t Count() const { return std::count(done_.begin(), done_.end(), 1); }
  // Returns the number of pixels of these rows that are not done. The columns are all of the
  // window.
  std::int64_t CountOpen(int y0, int y1) const {
    const auto begin = done_.begin() + std::ptrdiff_t(IndexOf({window_.x0, y0}));
    return std::count(begin, begin + std::ptrdiff_t(y1 - y0) * window_.Width(), 0);
  }

  // Saves or loads the pixels. Throws ArchiveError if the saved window was another one.
  void Transfer(ByteArchive* archive) {
    for (const int edge : {window_.x0, window_.y0, window_.x1, window_.y1}) archive->Same(edge);
    for (std::uint8_t& done : done_) {
      archive->Values(&done);
      if (done > 1) throw ArchiveError("a pixel is neither done nor open");
    }
  }

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - window_.y0) * std::size_t(window_.Width()) +
           std::size_t(pixel.x - window_.x0);
  }
  PixelBounds window_;
  std::vector<std::uint8_t> done_;
};

}  // namespace exphoton
