// SPDX-License-Identifier: BSD-2-Clause
// The searches for any machine, with Real16 as loops that the compiler may vectorise. This file
// also lists the searches that the machine supports and chooses the fastest.
#include <algorithm>
#include <bit>
#include <limits>

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
  std::size_t count = 1;
#if defined(EXPHOTON_WIDE_VECTORS)
  if (__builtin_cpu_supports("avx2")) ++count;
  if (count == 2 && __builtin_cpu_supports("avx512f")) ++count;
#endif
  return {all, count};
}

const NearestSearch& FastestNearestSearch() {
  static const NearestSearch& fastest = *AvailableNearestSearches().back();
  return fastest;
}

}  // namespace exphoton
