// SPDX-License-Identifier: BSD-2-Clause
// Writes a planned hierarchy as the arrays that rays walk through.
#pragma once

#include "accelerators/bvh/build/bvh_plan.h"

namespace exphoton {

// Reorders the items within the leaves. Throws Error (Resource) where they are too many.
BvhArrays WriteBvh(const PrimitiveSet& primitives, std::span<const BvhPlanNode> plan,
                   std::span<BvhItem> items, ThreadPool& threads);

}  // namespace exphoton
