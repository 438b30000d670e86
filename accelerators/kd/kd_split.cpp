// SPDX-License-Identifier: BSD-2-Clause
// The cost of a plane by the surface area heuristic is the expected number of tests for a random
// ray through the cell, on both sides.
#include "accelerators/kd/kd_split.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace exphoton {
namespace {

constexpr std::size_t kExactLimit = 64;  // largest number of items for which every plane is tried

// SplitCost computes the cost of splitting a cell along one axis.
class SplitCost {
 public:
  SplitCost(const Bounds3& cell, int axis, const KdCosts& costs) : costs_(costs), axis_(axis) {
    const Vector3 size = cell.Diagonal();
    const double a = double(size[(axis + 1) % 3]), b = double(size[(axis + 2) % 3]);
    low_ = double(cell.min[axis]), length_ = double(size[axis]);
    ends_ = 2 * a * b, perLength_ = 2 * (a + b);
    inverseArea_ = 1 / (ends_ + perLength_ * length_);
  }
  void Try(double position, std::size_t below, std::size_t above, KdSplit* best) const {
    const double pBelow = (ends_ + perLength_ * (position - low_)) * inverseArea_;
    const double pAbove = (ends_ + perLength_ * (low_ + length_ - position)) * inverseArea_;
    const double bonus = below == 0 || above == 0 ? 1 - costs_.emptyBonus : 1;
    const double cost = costs_.traverse + costs_.intersect * bonus *
                                              (pBelow * KdBlocks(below) + pAbove * KdBlocks(above));
    if (best->axis < 0 || cost < best->cost) *best = {axis_, float(position), cost};
  }

 private:
  const KdCosts& costs_;
  int axis_;
  double low_, length_, ends_, perLength_, inverseArea_;
};

// Tries the planes at both ends of all bounds, in one sorted sweep.
void TryEnds(std::span<const KdItem> items, const Bounds3& cell, int axis, const KdCosts& costs,
             KdSplit* best) {
  std::array<Real, kExactLimit> begins, ends;
  const std::size_t count = items.size();
  for (std::size_t i = 0; i < count; ++i) {
    begins[i] = items[i].bounds.min[axis];
    ends[i] = items[i].bounds.max[axis];
  }
  std::sort(begins.begin(), begins.begin() + std::ptrdiff_t(count));
  std::sort(ends.begin(), ends.begin() + std::ptrdiff_t(count));
  const SplitCost cost(cell, axis, costs);
  std::size_t begun = 0, ended = 0;  // before the plane; up to and including it
  while (ended < count) {
    const Real plane = begun < count ? std::min(begins[begun], ends[ended]) : ends[ended];
    std::size_t flat = 0;
    const std::size_t begunBefore = begun;
    while (begun < count && begins[begun] == plane) ++begun;
    const std::size_t endedBefore = ended;
    while (ended < count && ends[ended] == plane) ++ended;
    // Items that begin and end at this plane lie in it and count as below. Items that only begin
    // here count as above. For a cost, an upper bound on the number of items in the plane is
    // enough.
    flat = std::min(begun - begunBefore, ended - endedBefore);
    if (plane > cell.min[axis] && plane < cell.max[axis])
      cost.Try(double(plane), begunBefore + flat, count - ended, best);
  }
}

// In a double-precision build, rounding the plane to float may have moved it out of the cell.
KdSplit Checked(KdSplit split, const Bounds3& cell) {
  if (split.axis < 0) return split;
  const Real position = Real(split.position);
  if (!(position > cell.min[split.axis] && position < cell.max[split.axis])) split.axis = -1;
  return split;
}

}  // namespace

KdBins::KdBins(const Bounds3& cell) {
  for (int i = 0; i < 3; ++i) {
    const double length = double(cell.max[i]) - double(cell.min[i]);
    const double scale = length > 0 ? double(kCount) / length : 0;
    axes_[i].low = double(cell.min[i]);
    axes_[i].scale = std::isfinite(scale) ? scale : 0;
  }
}

void KdBins::Add(std::span<const KdItem> items) {
  for (const KdItem& item : items)
    for (int i = 0; i < 3; ++i) {
      Axis& axis = axes_[i];
      if (!(axis.scale > 0)) continue;  // no extent, or an infinite one
      const auto bin = [&](Real x) {
        const int number = int((double(x) - axis.low) * axis.scale);
        return std::size_t(std::clamp(number, 0, int(kCount) - 1));
      };
      ++axis.begins[bin(item.bounds.min[i])];
      ++axis.ends[bin(item.bounds.max[i])];
    }
  items_ += items.size();
}

void KdBins::Add(const KdBins& others) {
  for (int i = 0; i < 3; ++i)
    for (std::size_t bin = 0; bin < kCount; ++bin) {
      axes_[i].begins[bin] += others.axes_[i].begins[bin];
      axes_[i].ends[bin] += others.axes_[i].ends[bin];
    }
  items_ += others.items_;
}

KdSplit FindKdSplit(const KdBins& bins, const Bounds3& cell, const KdCosts& costs) {
  KdSplit best;
  if (!(cell.SurfaceArea() > 0)) return best;
  for (int i = 0; i < 3; ++i) {
    const KdBins::Axis& axis = bins.axes_[i];
    if (!(axis.scale > 0)) continue;
    const double length = double(cell.max[i]) - axis.low;
    const SplitCost cost(cell, i, costs);
    std::size_t below = 0, above = bins.items_;
    for (std::size_t bin = 1; bin < KdBins::kCount; ++bin) {
      below += axis.begins[bin - 1];
      above -= axis.ends[bin - 1];
      const float plane = float(axis.low + length * double(bin) / double(KdBins::kCount));
      if (Real(plane) > cell.min[i] && Real(plane) < cell.max[i])
        cost.Try(double(plane), below, above, &best);
    }
  }
  return Checked(best, cell);
}

KdSplit FindKdSplit(std::span<const KdItem> items, const Bounds3& cell, const KdCosts& costs) {
  if (items.size() > kExactLimit) {
    KdBins bins(cell);
    bins.Add(items);
    return FindKdSplit(bins, cell, costs);
  }
  KdSplit best;
  if (!(cell.SurfaceArea() > 0)) return best;
  for (int axis = 0; axis < 3; ++axis) TryEnds(items, cell, axis, costs, &best);
  return Checked(best, cell);
}

}  // namespace exphoton
