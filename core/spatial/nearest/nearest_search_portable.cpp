// SPDX-License-Identifier: BSD-2-Clause
// The searches for any machine, with Real16 as loops that the compiler may vectorise. This file
// also lists the searches that the machine supports and chooses the fastest.
#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

#include "core/base/simd_targets.h"
#include "core/spatial/nearest/nearest_search.h"

namespace exphoton {
namespace {

#include "core/math/simd/real16_portable.inl"
#include "core/spatial/nearest/nearest_search.inl"

}  // namespace

const NearestSearch kPortableNearestSearch{"portable", FindBlockNear, Nearest, Closest};

std::span<const NearestSearch* const> AvailableNearestSearches() {
  static const NearestSearch* const all[] = {
    &kPortableNearestSearch,
#if defined(EXPHOTON_WIDE_VECTORS)
    &kAvx2NearestSearch,
    &kAvx512NearestSearch,
#endif
  };
  return {all, std::min(std::size(all), UsableSimdTargets())};
}

const NearestSearch& FastestNearestSearch() {
  static const NearestSearch& fastest = *AvailableNearestSearches().back();
  return fastest;
}

}  // namespace exphoton
