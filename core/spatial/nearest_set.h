// SPDX-License-Identifier: BSD-2-Clause
// NearestSet: keeps the k nearest of the points it is offered. Candidates are appended to a buffer
// and cut back to k by selection when it is full, which beats a heap: most offers cost one write.
// What else a point must fulfil is asked once for the whole buffer, shortly before it is cut.
#pragma once

#include <algorithm>
#include <span>

#include "core/spatial/point_kdtree.h"

namespace exphoton {

// Reorders points so that the k nearest come first, the farthest of them last: nth_element at
// k - 1, 1 <= k <= points.size(). Quicker for squared distances on surfaces, which are spread about
// evenly: pivots are interpolated, and partitions take no branch.
void SelectNearest(std::span<NearPoint> points, std::size_t k);

// Keep(index) says whether a point counts.
template <class Keep>
class NearestSet {
 public:
  static std::size_t BufferSize(int k) {
    return 4 * std::size_t(k) + 2 * PointKdTree::kMaxLeafPoints;
  }

  // buffer.size() >= BufferSize(k).
  NearestSet(std::span<NearPoint> buffer, int k, Keep keep)
      : buffer_(buffer), k_(std::size_t(k)), keep_(keep) {}

  // Offers the points of a leaf, those with distance2[j] <= *radius2. Lowers *radius2 to the k-th
  // distance known so far whenever the buffer is cut. No branch for a point.
  void OfferLeaf(const PointKdTree::Leaf& leaf, const Real* distance2, Real* radius2) {
    if (count_ + leaf.count > buffer_.size()) Cut(radius2);
    const Real limit2 = *radius2;
    NearPoint* const buffer = buffer_.data();
    std::size_t count = count_;
    for (std::uint32_t j = 0; j < leaf.count; ++j) {
      buffer[count] = {distance2[j], leaf.begin + j};
      count += distance2[j] <= limit2;
    }
    count_ = count;
  }

  // Whether fewer than k have been found.
  bool IsShort() {
    Filter();
    return count_ < k_;
  }
  void Clear() { count_ = 0, kept_ = 0; }

  // The k nearest (all, if fewer were found); the farthest of them is last where there are k.
  std::span<const NearPoint> Finish() {
    if (!IsShort()) SelectNearest(buffer_.first(count_), k_), count_ = k_;
    return buffer_.first(count_);
  }

 private:
  void Filter() {
    for (std::size_t i = kept_; i < count_; ++i) {
      buffer_[kept_] = buffer_[i];
      kept_ += keep_(buffer_[i].index);
    }
    count_ = kept_;
  }
  void Cut(Real* radius2) {
    if (IsShort()) return;  // the buffer holds k and a leaf
    SelectNearest(buffer_.first(count_), k_);
    count_ = kept_ = k_;
    *radius2 = buffer_[k_ - 1].distance2;
  }

  std::span<NearPoint> buffer_;
  std::size_t k_, count_ = 0, kept_ = 0;  // the first kept_ are known to count
  Keep keep_;
};

struct KeepAll {
  bool operator()(std::uint32_t) const { return true; }
};

}  // namespace exphoton
