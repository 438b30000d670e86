// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/bvh/build/binned_split.h"

#include <array>
#include <cmath>

namespace exphoton {
namespace {

constexpr int kBins = 32;
constexpr std::size_t kSweepLimit = 64;  // largest number of items for which every split is tried

// Returns the cost of testing `count` triangles, in blocks of eight.
double Blocks(std::uint32_t count) { return double((count + 7) / 8); }

// Binning maps the centre of a box to one bin per axis.
class Binning {
 public:
  explicit Binning(const BuildBox& middles) : min_(middles.low) {
    const Bounds3 bounds = middles.ToBounds();
    Point3 scale;
    for (int axis = 0; axis < 3; ++axis) {
      const Real extent = bounds.max[axis] * Real(.5) - bounds.min[axis] * Real(.5);
      // An extent whose inverse overflows is not binned.
      const bool isWide = extent > Real(kBins) * std::numeric_limits<Real>::min();
      scale[axis] = isWide ? Real(kBins) / 2 / extent : 0;
      canSplit_[axis] = scale[axis] > 0;
    }
    scale_ = Real4::Of(scale);
  }
  bool CanSplit(int axis) const { return canSplit_[axis]; }
  void Find(const BvhItem& item, std::int32_t* bins) const {
    const Real4 position = (item.Box().Center() - min_) * scale_;
    Max(Min(position, Real4::All(kBins - 1)), Real4::All(0)).Truncate(bins);
  }

 private:
  Real4 min_, scale_;
  bool canSplit_[3];
};

struct Bins {
  BuildBox boxes[3][kBins];
  std::uint32_t counts[3][kBins] = {};
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1, bin = 0;  // the first part consists of the bins below
};

void TryAxis(const Bins& bins, int axis, Split* best) {
  std::array<double, kBins> below;
  BuildBox box;
  std::uint32_t count = 0;
  for (int i = 0; i + 1 < kBins; ++i) {
    box.Extend(bins.boxes[axis][i]);
    count += bins.counts[axis][i];
    below[i + 1] = count ? HalfArea(box) * Blocks(count) : -1;
  }
  box = {};
  count = 0;
  for (int i = kBins - 1; i > 0; --i) {
    box.Extend(bins.boxes[axis][i]);
    count += bins.counts[axis][i];
    if (count == 0 || below[i] < 0) continue;
    const double cost = below[i] + HalfArea(box) * Blocks(count);
    if (cost < best->cost) *best = {cost, axis, i};
  }
}

// Sorts the items along one axis. Items with equal centres keep their order. Each item's place is
// the number of items before it. For few items, counting is faster than sorting with unpredictable
// branches.
using Places = std::array<std::uint8_t, kSweepLimit>;
void SortPlaces(const std::array<Real, kSweepLimit>& middles, std::size_t count, Places* places) {
  for (std::size_t i = 0; i < count; ++i) {
    const Real middle = middles[i];
    std::int32_t before = 0;
    for (std::size_t j = 0; j < i; ++j) before += middles[j] <= middle;
    for (std::size_t j = i + 1; j < count; ++j) before += middles[j] < middle;
    (*places)[std::size_t(before)] = std::uint8_t(i);
  }
}

void Sweep(std::span<const BvhItem> items, const Places& places, int axis, BvhSplit* best) {
  std::array<double, kSweepLimit> below;
  BuildBox box;
  for (std::size_t i = 1; i < items.size(); ++i) {
    box.Extend(items[places[i - 1]].Box());
    below[i] = HalfArea(box) * Blocks(std::uint32_t(i));
  }
  box = {};
  for (std::size_t i = items.size() - 1; i > 0; --i) {
    box.Extend(items[places[i]].Box());
    const double cost = below[i] + HalfArea(box) * Blocks(std::uint32_t(items.size() - i));
    if (cost < best->cost) *best = {i, axis, cost};
  }
}

// Tries every split of a small run in its order along each axis.
BvhSplit SweepRun(const BvhRun& run) {
  const std::span<BvhItem> items = run.items;
  std::array<Real, kSweepLimit> middles[3];
  for (std::size_t i = 0; i < items.size(); ++i) {
    Real lanes[4];
    items[i].Box().Center().Store(lanes);
    for (int axis = 0; axis < 3; ++axis) middles[axis][i] = lanes[axis];
  }
  const Bounds3 bounds = run.middles.ToBounds();
  BvhSplit best{0, 0, std::numeric_limits<double>::infinity()};
  Places places[3];
  for (int axis = 0; axis < 3; ++axis) {
    if (!(bounds.max[axis] > bounds.min[axis])) continue;
    SortPlaces(middles[axis], items.size(), &places[axis]);
    Sweep(items, places[axis], axis, &best);
  }
  if (best.count == 0) return HalveRun(run);
  std::array<BvhItem, kSweepLimit> sorted;
  for (std::size_t i = 0; i < items.size(); ++i) sorted[i] = items[places[best.axis][i]];
  std::copy_n(sorted.begin(), items.size(), items.begin());
  return best;
}

}  // namespace

BvhRun MakeRun(std::span<BvhItem> items) {
  BvhRun run{items, {}, {}};
  for (const BvhItem& item : items) {
    run.box.Extend(item.Box());
    run.middles.Extend(item.Box().Center());
  }
  return run;
}

double LeafCost(const BvhRun& run) {
  return HalfArea(run.box) * Blocks(std::uint32_t(run.items.size()));
}

BvhSplit HalveRun(const BvhRun& run) {
  const Bounds3 bounds = run.middles.ToBounds();
  const int axis = MaxDimension(bounds.max * Real(.5) - bounds.min * Real(.5));
  const std::size_t half = run.items.size() / 2;
  const auto middle = [axis](const BvhItem& item) {
    Real lanes[4];
    item.Box().Center().Store(lanes);
    return lanes[axis];
  };
  std::nth_element(run.items.begin(), run.items.begin() + std::ptrdiff_t(half), run.items.end(),
                   [&](const BvhItem& a, const BvhItem& b) {
                     const Real x = middle(a), y = middle(b);
                     return x != y ? x < y : a.id < b.id;
                   });
  return {half, axis, std::numeric_limits<double>::infinity()};
}

BvhSplit SplitRun(const BvhRun& run) {
  if (run.items.size() <= kSweepLimit) return SweepRun(run);
  const Binning binning(run.middles);
  Bins bins;
  for (const BvhItem& item : run.items) {
    std::int32_t at[4];
    binning.Find(item, at);
    for (int axis = 0; axis < 3; ++axis) {
      bins.boxes[axis][at[axis]].Extend(item.Box());
      ++bins.counts[axis][at[axis]];
    }
  }
  Split best;
  for (int axis = 0; axis < 3; ++axis)
    if (binning.CanSplit(axis)) TryAxis(bins, axis, &best);
  if (best.axis < 0) return HalveRun(run);
  const auto isBelow = [&](const BvhItem& item) {
    std::int32_t at[4];
    binning.Find(item, at);
    return at[best.axis] < best.bin;
  };
  const auto middle = std::partition(run.items.begin(), run.items.end(), isBelow);
  return {std::size_t(middle - run.items.begin()), best.axis, best.cost};
}

}  // namespace exphoton
