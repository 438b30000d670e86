// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/bvh/build/child_order.h"

#include <algorithm>
#include <numeric>

namespace exphoton {
namespace {

BvhOrder Pack(const std::array<std::uint8_t, kBvhWidth>& lanes) {
  BvhOrder order = 0;
  for (int i = 0; i < kBvhWidth; ++i) order |= BvhOrder(lanes[i]) << (4 * i);
  return order;
}

}  // namespace

NearOrders::NearOrders() {
  for (auto& order : orders_) std::iota(order.begin(), order.end(), std::uint8_t(0));
}

void NearOrders::Split(int lower, int upper, int axis) {
  for (unsigned signs = 0; signs < orders_.size(); ++signs) {
    const auto begin = orders_[signs].begin(), end = begin + count_;
    const bool isBackward = signs >> axis & 1;
    const auto place = std::find(begin, end, std::uint8_t(lower)) + !isBackward;
    std::copy_backward(place, end, end + 1);
    *place = std::uint8_t(upper);
  }
  ++count_;
}

std::array<BvhOrder, 5> NearOrders::Packed() const {
  std::array<BvhOrder, 5> packed{};
  for (std::size_t i = 0; i < orders_.size(); ++i) packed[i] = Pack(orders_[i]);
  return packed;
}

Blocking OrderByBlocking(std::span<const ChildBlocking> children, BvhOrder* order) {
  std::array<std::uint8_t, kBvhWidth> lanes;
  std::iota(lanes.begin(), lanes.end(), std::uint8_t(0));
  std::stable_sort(lanes.begin(), lanes.begin() + std::ptrdiff_t(children.size()),
                   [&](std::uint8_t a, std::uint8_t b) {
                     const Blocking &x = children[a].inside, &y = children[b].inside;
                     return x.chance * y.work > y.chance * x.work;
                   });
  *order = Pack(lanes);
  Blocking all{0, 1};
  double free = 1;  // probability that nothing has blocked the ray so far
  for (std::size_t i = 0; i < children.size(); ++i) {
    const ChildBlocking& child = children[lanes[i]];
    all.work += free * child.entered * child.inside.work;
    free *= 1 - child.entered * child.inside.chance;
  }
  all.chance = 1 - free;
  return all;
}

}  // namespace exphoton
