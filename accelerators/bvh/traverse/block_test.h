// SPDX-License-Identifier: BSD-2-Clause
// Testing a run of triangle blocks against a ray, with the widest vectors of the machine: the leaf
// test of the hierarchy, for other accelerators whose leaves have such blocks.
#pragma once

#include <span>

#include "accelerators/bvh/bvh_layout.h"
#include "accelerators/bvh/traverse/traverse.h"

namespace exphoton {

// Fills a block with up to kBvhWidth triangles of the set.
BvhBlock MakeBlock(const PrimitiveSet& primitives, std::span<const std::uint32_t> ids);

}  // namespace exphoton
