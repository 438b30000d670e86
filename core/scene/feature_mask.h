// SPDX-License-Identifier: BSD-2-Clause
// kCompiledFeatures is the set of features in this build: bit i represents Feature(i) of
// required_features.h. Normal builds have all features. Builds that measure the cost of a feature
// (CMake option EXPHOTON_EFFECTS) use a generated header of the same name, which precedes this one.
#pragma once

namespace exphoton {

inline constexpr unsigned kCompiledFeatures = ~0u;

}  // namespace exphoton
