// SPDX-License-Identifier: BSD-2-Clause
// Construction of a bounding volume hierarchy over a set of primitives. Builds the arrays; knows
// nothing of rays. The result depends on the set alone, not on the threads.
#pragma once

#include "accelerators/bvh/bvh_layout.h"
#include "core/base/parallel.h"

namespace exphoton {

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles,
                   ThreadPool& threads);

// Below, threads would take longer to start than to save.
inline constexpr std::uint32_t kBvhFewPrimitives = 20000;

}  // namespace exphoton
