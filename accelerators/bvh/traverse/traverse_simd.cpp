// SPDX-License-Identifier: BSD-2-Clause
// The traversal of the BVH, compiled for each SIMD target.
#include "accelerators/bvh/traverse/traverse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <iterator>
#include <new>

#include "core/geometry/triangle_single.h"
#include "core/math/simd/targets.h"
#include "core/scene/aggregate.h"
#include "core/scene/hit_order.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accelerators/bvh/traverse/traverse_simd.cpp"
#include <hwy/foreach_target.h>

#include "core/math/simd/reals.inl"

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {
namespace {

#include "accelerators/bvh/traverse/real8.inl"

#include "accelerators/bvh/traverse/traverse.inl"

}  // namespace

extern const BvhTraversal kTraversal;
const BvhTraversal kTraversal{kTargetName,     Intersect,    Occluded,        MakeBlockRay,
                              IntersectBlocks, FindDistance, OccludedByBlocks};

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

const BvhTraversal& FastestTraversal(BvhVectors widest) {
  static const BvhTraversal* const all[] = EXPHOTON_SIMD_TARGETS(kTraversal);
  return *all[std::min(std::size_t(widest), UsableSimdTargets() - 1)];
}

}  // namespace exphoton
#endif
