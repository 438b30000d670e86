// SPDX-License-Identifier: BSD-2-Clause
// NearestSet: keeps the k nearest of the points it is offered. Candidates are appended to a buffer
// and cut back to k by selection when it is full, which beats a heap: most offers cost one write.
#pragma once

#include <algorithm>
#include <span>

#include "core/spatial/point_kdtree.h"

namespace exphoton {

class NearestSet {
 public:
  static std::size_t BufferSize(int k) { return 2 * std::size_t(k) + 16; }

  // buffer.size() >= BufferSize(k).
  NearestSet(std::span<NearPoint> buffer, int k) : buffer_(buffer), k_(std::size_t(k)) {}

  // Lowers *radius2 to the k-th distance known so far whenever the buffer is cut.
  void Offer(NearPoint point, Real* radius2) {
    buffer_[count_++] = point;
    if (count_ == buffer_.size()) Cut(radius2);
  }
  // The k nearest (all, if fewer were offered); the farthest of them is last where there are k.
  std::span<const NearPoint> Finish() {
    Real ignored = 0;
    if (count_ >= k_) Cut(&ignored);
    return buffer_.first(count_);
  }

 private:
  void Cut(Real* radius2) {
    const auto begin = buffer_.begin();
    std::nth_element(begin, begin + std::ptrdiff_t(k_ - 1), begin + std::ptrdiff_t(count_));
    count_ = k_;
    *radius2 = buffer_[k_ - 1].distance2;
  }

  std::span<NearPoint> buffer_;
  std::size_t k_, count_ = 0;
};

}  // namespace exphoton
