// SPDX-License-Identifier: BSD-2-Clause
// Which effects a build has: bit i stands for Feature(i) of effects.h. All of them, but in builds
// that measure what carrying an effect costs: those have a header of this name, made by CMake
// (EXPHOTON_EFFECTS), before this one.
#pragma once

namespace exphoton {

inline constexpr unsigned kCompiledFeatures = ~0u;

}  // namespace exphoton
