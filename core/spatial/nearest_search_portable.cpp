// SPDX-License-Identifier: BSD-2-Clause
// The searches for any machine: vectors of sixteen as loops that the compiler maps to what there
// is. Also the choice between the searches.
#include <algorithm>
#include <bit>
#include <limits>

#include "core/spatial/nearest_search.h"

namespace exphoton {
namespace {

struct Real16 {
  Real lanes[kBlockPoints];

  static Real16 Load(const Real* row) {
    Real16 r;
    for (std::uint32_t i = 0; i < kBlockPoints; ++i) r.lanes[i] = row[i];
    return r;
  }
  static Real16 LoadUnaligned(const Real* row) { return Load(row); }
  static Real16 All(Real x) {
    Real16 r;
    for (Real& lane : r.lanes) lane = x;
    return r;
  }
  void StoreUnaligned(Real* row) const {
    for (std::uint32_t i = 0; i < kBlockPoints; ++i) row[i] = lanes[i];
  }
};

#define EXPHOTON_LANEWISE(name, expression)              \
  inline Real16 name(const Real16& a, const Real16& b) { \
    Real16 r;                                            \
    for (std::uint32_t i = 0; i < kBlockPoints; ++i) {   \
      const Real x = a.lanes[i], y = b.lanes[i];         \
      r.lanes[i] = (expression);                         \
    }                                                    \
    return r;                                            \
  }
EXPHOTON_LANEWISE(operator+, x + y)
EXPHOTON_LANEWISE(operator-, x - y)
EXPHOTON_LANEWISE(operator*, x* y)
EXPHOTON_LANEWISE(Min, x < y ? x : y)
EXPHOTON_LANEWISE(Max, x > y ? x : y)
EXPHOTON_LANEWISE(CopySign, std::copysign(x, y))
#undef EXPHOTON_LANEWISE
inline Real16 Sqrt(const Real16& a) {
  Real16 r;
  for (std::uint32_t i = 0; i < kBlockPoints; ++i) r.lanes[i] = std::sqrt(a.lanes[i]);
  return r;
}
inline Real16 Abs(const Real16& a) {
  Real16 r;
  for (std::uint32_t i = 0; i < kBlockPoints; ++i) r.lanes[i] = std::abs(a.lanes[i]);
  return r;
}

#define EXPHOTON_COMPARE(name, comparison)                     \
  inline unsigned name(const Real16& a, const Real16& b) {     \
    unsigned mask = 0;                                         \
    for (std::uint32_t i = 0; i < kBlockPoints; ++i)           \
      mask |= unsigned(a.lanes[i] comparison b.lanes[i]) << i; \
    return mask;                                               \
  }
EXPHOTON_COMPARE(LessEqualMask, <=)
EXPHOTON_COMPARE(LessMask, <)
EXPHOTON_COMPARE(EqualMask, ==)
#undef EXPHOTON_COMPARE

inline void LoadOctahedral(const std::uint32_t* bits, Real16* a, Real16* b) {
  for (std::uint32_t i = 0; i < kBlockPoints; ++i) {
    const auto word = std::int32_t(bits[i]);
    a->lanes[i] = Real(std::int32_t(bits[i] << 16) >> 16);
    b->lanes[i] = Real(word >> 16);
  }
}

// The lane of the mask (not 0) with the least value, the lowest of equals.
inline unsigned NearestLane(const Real16& values, unsigned mask) {
  unsigned nearest = unsigned(__builtin_ctz(mask));
  for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
    const auto lane = unsigned(__builtin_ctz(rest));
    nearest = values.lanes[lane] < values.lanes[nearest] ? lane : nearest;
  }
  return nearest;
}
// The least value; bits of the mask beyond the lanes mean nothing.
inline Real LeastOf(const Real16& values, unsigned mask) {
  Real least = kInfinity;
  for (std::uint32_t i = 0; i < kBlockPoints; ++i)
    least = (mask >> i & 1) && values.lanes[i] < least ? values.lanes[i] : least;
  return least;
}

inline std::size_t CountLessEqual(const Real16& a, const Real16& b) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kBlockPoints; ++i) count += a.lanes[i] <= b.lanes[i];
  return count;
}
// a where a <= b, 0 elsewhere.
inline Real16 IfLessEqual(const Real16& a, const Real16& b) {
  Real16 r;
  for (std::uint32_t i = 0; i < kBlockPoints; ++i)
    r.lanes[i] = a.lanes[i] <= b.lanes[i] ? a.lanes[i] : Real(0);
  return r;
}

// The lanes of the mask, one after the other; how many there were.
inline std::size_t KeepLanes(const Real16& values, unsigned mask, const std::uint32_t* from,
                             Real* distance2, std::uint32_t* index) {
  std::size_t count = 0;
  for (; mask != 0; mask &= mask - 1) {
    const auto lane = unsigned(__builtin_ctz(mask));
    distance2[count] = values.lanes[lane];
    index[count++] = from[lane];
  }
  return count;
}
inline std::size_t AppendLanes(const Real16& values, std::uint32_t firstIndex, unsigned mask,
                               Real* distance2, std::uint32_t* index) {
  std::size_t count = 0;
  for (; mask != 0; mask &= mask - 1) {
    const auto lane = unsigned(__builtin_ctz(mask));
    distance2[count] = values.lanes[lane];
    index[count++] = firstIndex + lane;
  }
  return count;
}

#include "core/spatial/nearest_search.inl"

}  // namespace

const NearestSearch kPortableNearestSearch{"portable", FindBlockNear, Nearest, Closest};

std::span<const NearestSearch* const> AvailableNearestSearches() {
  static const NearestSearch* const all[] = {
    &kPortableNearestSearch,
#if defined(EXPHOTON_WIDE_SEARCH)
    &kAvx2NearestSearch,
    &kAvx512NearestSearch,
#endif
  };
  std::size_t count = 1;
#if defined(EXPHOTON_WIDE_SEARCH)
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
