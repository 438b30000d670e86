// SPDX-License-Identifier: BSD-2-Clause
// The surface area heuristic: a plane costs what a random ray through the cell is expected to meet
// on each side.
#include "accelerators/kd/kd_split.h"

#include <algorithm>
#include <array>

namespace exphoton {
namespace {

constexpr std::size_t kExactLimit = 64;  // items up to which every plane is tried
constexpr int kBins = 64;

// What splitting a cell along one axis costs.
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

// Planes at the ends of all bounds, from a sweep over them in order.
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
  std::size_t begun = 0, ended = 0;  // before the plane; up to and with the plane
  while (ended < count) {
    const Real plane = begun < count ? std::min(begins[begun], ends[ended]) : ends[ended];
    std::size_t flat = 0;
    const std::size_t begunBefore = begun;
    while (begun < count && begins[begun] == plane) ++begun;
    const std::size_t endedBefore = ended;
    while (ended < count && ends[ended] == plane) ++ended;
    // Items that begin and end here lie in the plane: counted as below. Those that only begin here
    // are not; which of them are flat need not be known exactly for a cost.
    flat = std::min(begun - begunBefore, ended - endedBefore);
    if (plane > cell.min[axis] && plane < cell.max[axis])
      cost.Try(double(plane), begunBefore + flat, count - ended, best);
  }
}

void TryBins(std::span<const KdItem> items, const Bounds3& cell, int axis, const KdCosts& costs,
             KdSplit* best) {
  const double low = double(cell.min[axis]), length = double(cell.max[axis]) - low;
  if (!(length > 0)) return;
  std::array<std::size_t, kBins> begins{}, ends{};
  const auto bin = [&](Real x) {
    return std::size_t(std::clamp(int((double(x) - low) / length * kBins), 0, kBins - 1));
  };
  for (const KdItem& item : items) {
    ++begins[bin(item.bounds.min[axis])];
    ++ends[bin(item.bounds.max[axis])];
  }
  const SplitCost cost(cell, axis, costs);
  std::size_t below = 0, above = items.size();
  for (std::size_t i = 1; i < kBins; ++i) {
    below += begins[i - 1];
    above -= ends[i - 1];
    const float plane = float(low + length * double(i) / kBins);
    if (Real(plane) > cell.min[axis] && Real(plane) < cell.max[axis])
      cost.Try(double(plane), below, above, best);
  }
}

}  // namespace

KdSplit FindKdSplit(std::span<const KdItem> items, const Bounds3& cell, const KdCosts& costs) {
  KdSplit best;
  if (!(cell.SurfaceArea() > 0)) return best;
  for (int axis = 0; axis < 3; ++axis) {
    if (items.size() <= kExactLimit) {
      TryEnds(items, cell, axis, costs, &best);
    } else {
      TryBins(items, cell, axis, costs, &best);
    }
  }
  // In a build with doubles the plane is rounded and may have left the cell.
  if (best.axis >= 0) {
    const Real position = Real(best.position);
    if (!(position > cell.min[best.axis] && position < cell.max[best.axis])) best.axis = -1;
  }
  return best;
}

}  // namespace exphoton
