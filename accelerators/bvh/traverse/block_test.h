// SPDX-License-Identifier: BSD-2-Clause
// BvhTraversal's block functions test a run of triangle blocks against a ray, with the widest SIMD
// target of the machine. This is the leaf test of the BVH, for other accelerators whose leaves
// consist of such blocks.
#pragma once

#include <span>

#include "accelerators/bvh/bvh_layout.h"
#include "accelerators/bvh/traverse/traverse.h"

namespace exphoton {

// Returns a block with up to kBvhWidth triangles of the set.
BvhBlock MakeBlock(const PrimitiveSet& primitives, std::span<const std::uint32_t> ids);

}  // namespace exphoton
