// SPDX-License-Identifier: BSD-2-Clause
// Construction of a bounding volume hierarchy over a set of primitives. Builds the arrays; knows
// nothing of rays. The result depends on the set alone.
#pragma once

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles);

}  // namespace exphoton
