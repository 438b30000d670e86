// SPDX-License-Identifier: BSD-2-Clause
// The searches, compiled for each SIMD target.
#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

#include "core/math/simd/targets.h"
#include "core/spatial/nearest_search.h"
#include "core/spatial/search_start.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/spatial/nearest_search_simd.cpp"
#include <hwy/foreach_target.h>

#include "core/math/simd/reals.inl"

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {
namespace {

#include "core/spatial/distances.inl"

#include "core/spatial/closest_disk.inl"
#include "core/spatial/k_nearest.inl"

}  // namespace

extern const NearestSearch kNearestSearch;
const NearestSearch kNearestSearch{kTargetName, FindBlockNear, KNearest, ClosestDisks};

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

std::span<const NearestSearch* const> AvailableNearestSearches() {
  static const NearestSearch* const all[] = EXPHOTON_SIMD_TARGETS(kNearestSearch);
  return {all, UsableSimdTargets()};
}

const NearestSearch& FastestNearestSearch() {
  static const NearestSearch& fastest = *AvailableNearestSearches().back();
  return fastest;
}

}  // namespace exphoton
#endif
