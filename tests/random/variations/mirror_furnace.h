// SPDX-License-Identifier: BSD-2-Clause
// CompareInMirrorFurnace compares the light AOVs in a closed sphere with exact ones. The wall is a
// mix of a matte material and a mirror, and emits so much that each radiance is 1.
#pragma once

#include "tests/random/variations/parts.h"

namespace exphoton::random_scenes {

std::vector<Comparison> CompareInMirrorFurnace(const Effort& effort);

}  // namespace exphoton::random_scenes
