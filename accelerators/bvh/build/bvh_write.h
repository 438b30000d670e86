// SPDX-License-Identifier: BSD-2-Clause
// WriteBvh converts a planned hierarchy to the arrays that rays traverse.
#pragma once

#include "accelerators/bvh/build/bvh_plan.h"

namespace exphoton {

// Reorders the items within the leaves. Throws Error (Resource) if the arrays would be too large.
BvhArrays WriteBvh(const PrimitiveSet& primitives, std::span<const BvhPlanNode> plan,
                   std::span<BvhItem> items, ThreadPool& threads);

}  // namespace exphoton
