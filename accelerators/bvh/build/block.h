// SPDX-License-Identifier: BSD-2-Clause
// MakeBlock packs up to 8 triangles into a BvhBlock, the leaf format of the BVH. Other accelerators
// may use such blocks too, with the leaf-test functions of BvhTraversal (traverse/traverse.h).
#pragma once

#include <span>

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

// Returns a block with up to kBvhWidth triangles of the set.
BvhBlock MakeBlock(const PrimitiveSet& primitives, std::span<const std::uint32_t> ids);

}  // namespace exphoton
