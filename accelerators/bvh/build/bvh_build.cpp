// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/bvh/build/bvh_build.h"

#include "accelerators/bvh/build/bvh_plan.h"
#include "accelerators/bvh/build/bvh_write.h"

namespace exphoton {
namespace {

constexpr std::uint32_t kChunkItems = 8192;  // primitives per task that computes bounds

std::vector<BvhItem> MakeItems(const PrimitiveSet& primitives, ThreadPool& threads) {
  const std::uint32_t count = primitives.Count();
  std::vector<BvhItem> items(count);
  threads.For((count + kChunkItems - 1) / kChunkItems, [&](std::int64_t chunk, int) {
    const auto begin = std::uint32_t(chunk) * kChunkItems;
    for (std::uint32_t id = begin; id < std::min(begin + kChunkItems, count); ++id) {
      const Bounds3 bounds = primitives.Bounds(id);
      items[id] = bounds.IsEmpty() ? BvhItem({}, kNoId) : BvhItem(PaddedBounds(bounds), id);
    }
  });
  std::erase_if(items, [](const BvhItem& item) { return item.id == kNoId; });  // empty
  return items;
}

}  // namespace

Bounds3 PaddedBounds(const Bounds3& bounds) {
  constexpr Real kLargest = std::numeric_limits<Real>::max();
  const Real margin = kBvhMargin * MaxComponent(bounds.Diagonal());
  Bounds3 padded = bounds;
  for (int axis = 0; axis < 3; ++axis) {
    padded.min[axis] = std::max(NextDown(bounds.min[axis] - margin), -kLargest);
    padded.max[axis] = std::min(NextUp(bounds.max[axis] + margin), kLargest);
  }
  return padded;
}

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                   ThreadPool& threads) {
  std::vector<BvhItem> items = MakeItems(primitives, threads);
  if (items.empty()) return {};
  const std::uint32_t most = std::min(maxLeafTriangles, std::uint32_t(kBvhWidth));
  return WriteBvh(primitives, PlanBvh(primitives, most, items, threads), items, threads);
}

}  // namespace exphoton
