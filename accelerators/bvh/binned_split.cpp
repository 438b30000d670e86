// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/bvh/binned_split.h"

#include <array>

namespace exphoton {
namespace {

constexpr int kBins = 32;
constexpr std::size_t kSweepLimit = 64;  // items up to which every place is tried

struct Bin {
  Bounds3 bounds;
  std::uint32_t count = 0;
};

// Which bin a middle belongs to; the same function bins and partitions.
class Binning {
 public:
  Binning(const Bounds3& centroids, int axis) : axis_(axis), min_(centroids.min[axis]) {
    const Real extent = centroids.max[axis] * Real(.5) - min_ * Real(.5);
    scale_ = extent > 0 ? Real(kBins) / 2 / extent : 0;
    if (!std::isfinite(scale_)) scale_ = 0;
  }
  bool CanSplit() const { return scale_ > 0; }
  int Axis() const { return axis_; }
  int operator()(const BvhItem& item) const {
    const Real position = (item.Centroid(axis_) - min_) * scale_;
    return std::clamp(int(std::min(position, Real(kBins))), 0, kBins - 1);
  }

 private:
  int axis_;
  Real min_, scale_;
};

struct Split {
  double cost = std::numeric_limits<double>::infinity();
  int axis = -1, bin = 0;  // the first part has the bins below
};

// Cost by blocks of eight: what a leaf below will hold.
double Blocks(std::uint32_t count) { return double((count + 7) / 8); }

Split BestSplit(const std::array<Bin, kBins>& bins, int axis) {
  std::array<double, kBins> below;
  Bounds3 bounds;
  std::uint32_t count = 0;
  for (int i = 0; i + 1 < kBins; ++i) {
    bounds.Extend(bins[i].bounds);
    count += bins[i].count;
    below[i + 1] = count ? HalfArea(bounds) * Blocks(count) : -1;
  }
  Split best;
  bounds = {};
  count = 0;
  for (int i = kBins - 1; i > 0; --i) {
    bounds.Extend(bins[i].bounds);
    count += bins[i].count;
    if (count == 0 || below[i] < 0) continue;
    const double cost = below[i] + HalfArea(bounds) * Blocks(count);
    if (cost < best.cost) best = {cost, axis, i};
  }
  return best;
}

void SortAlong(std::span<BvhItem> items, int axis) {
  std::sort(items.begin(), items.end(), [axis](const BvhItem& a, const BvhItem& b) {
    const Real x = a.Centroid(axis), y = b.Centroid(axis);
    return x != y ? x < y : a.id < b.id;
  });
}

// Few items: every place in their order along each axis.
BvhSplit SweepRun(const BvhRun& run) {
  const std::span<BvhItem> items = run.items;
  std::array<double, kSweepLimit> below;
  BvhSplit best{0, 0, std::numeric_limits<double>::infinity()};
  int sorted = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(run.centroids.max[axis] > run.centroids.min[axis])) continue;
    SortAlong(items, axis);
    sorted = axis;
    Bounds3 bounds;
    for (std::size_t i = 1; i < items.size(); ++i) {
      bounds.Extend(items[i - 1].bounds);
      below[i] = HalfArea(bounds) * Blocks(std::uint32_t(i));
    }
    bounds = {};
    for (std::size_t i = items.size() - 1; i > 0; --i) {
      bounds.Extend(items[i].bounds);
      const double cost = below[i] + HalfArea(bounds) * Blocks(std::uint32_t(items.size() - i));
      if (cost < best.cost) best = {i, axis, cost};
    }
  }
  if (best.count == 0) return HalveRun(run);
  if (sorted != best.axis) SortAlong(items, best.axis);
  return best;
}

}  // namespace

double HalfArea(const Bounds3& bounds) {
  const double x = double(bounds.max.x) - double(bounds.min.x);
  const double y = double(bounds.max.y) - double(bounds.min.y);
  const double z = double(bounds.max.z) - double(bounds.min.z);
  return x * y + y * z + z * x;
}

BvhRun MakeRun(std::span<BvhItem> items) {
  BvhRun run{items, {}, {}};
  for (const BvhItem& item : items) {
    run.bounds.Extend(item.bounds);
    run.centroids.Extend(Point3(item.Centroid(0), item.Centroid(1), item.Centroid(2)));
  }
  return run;
}

double LeafCost(const BvhRun& run) {
  return HalfArea(run.bounds) * Blocks(std::uint32_t(run.items.size()));
}

BvhSplit HalveRun(const BvhRun& run) {
  const Vector3 extent = run.centroids.max * Real(.5) - run.centroids.min * Real(.5);
  const int axis = MaxDimension(extent);
  const std::size_t half = run.items.size() / 2;
  std::nth_element(run.items.begin(), run.items.begin() + std::ptrdiff_t(half), run.items.end(),
                   [axis](const BvhItem& a, const BvhItem& b) {
                     const Real x = a.Centroid(axis), y = b.Centroid(axis);
                     return x != y ? x < y : a.id < b.id;
                   });
  return {half, axis, std::numeric_limits<double>::infinity()};
}

BvhSplit SplitRun(const BvhRun& run) {
  if (run.items.size() <= kSweepLimit) return SweepRun(run);
  Split best;
  for (int axis = 0; axis < 3; ++axis) {
    const Binning binning(run.centroids, axis);
    if (!binning.CanSplit()) continue;
    std::array<Bin, kBins> bins{};
    for (const BvhItem& item : run.items) {
      Bin& bin = bins[binning(item)];
      bin.bounds.Extend(item.bounds);
      ++bin.count;
    }
    const Split split = BestSplit(bins, axis);
    if (split.cost < best.cost) best = split;
  }
  if (best.axis < 0) return HalveRun(run);
  const Binning binning(run.centroids, best.axis);
  const auto middle = std::partition(run.items.begin(), run.items.end(),
                                     [&](const BvhItem& item) { return binning(item) < best.bin; });
  return {std::size_t(middle - run.items.begin()), best.axis, best.cost};
}

}  // namespace exphoton
