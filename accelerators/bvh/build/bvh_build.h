// SPDX-License-Identifier: BSD-2-Clause
// BuildBvh constructs a bounding volume hierarchy over a set of primitives. This file does not
// depend on ray traversal. The result depends on the primitives alone, not on the number of
// threads.
#pragma once

#include "accelerators/bvh/bvh_layout.h"
#include "core/base/parallel.h"

namespace exphoton {

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                   ThreadPool& threads);

// For fewer primitives, starting threads takes longer than they save.
inline constexpr std::uint32_t kBvhFewPrimitives = 20000;

}  // namespace exphoton
