// SPDX-License-Identifier: BSD-2-Clause
// Real16 for the portable target uses loops that the compiler maps to the available instructions.

struct Real16 {
  Real lanes[kReal16Lanes];

  static Real16 Load(const Real* row) {
    Real16 r;
    for (std::uint32_t i = 0; i < kReal16Lanes; ++i) r.lanes[i] = row[i];
    return r;
  }
  static Real16 LoadUnaligned(const Real* row) { return Load(row); }
  static Real16 All(Real x) {
    Real16 r;
    for (Real& lane : r.lanes) lane = x;
    return r;
  }
  void StoreUnaligned(Real* row) const {
    for (std::uint32_t i = 0; i < kReal16Lanes; ++i) row[i] = lanes[i];
  }
};

#define EXPHOTON_LANEWISE(name, expression)              \
  inline Real16 name(const Real16& a, const Real16& b) { \
    Real16 r;                                            \
    for (std::uint32_t i = 0; i < kReal16Lanes; ++i) {   \
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
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i) r.lanes[i] = std::sqrt(a.lanes[i]);
  return r;
}
inline Real16 Abs(const Real16& a) {
  Real16 r;
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i) r.lanes[i] = std::abs(a.lanes[i]);
  return r;
}

#define EXPHOTON_COMPARE(name, comparison)                     \
  inline unsigned name(const Real16& a, const Real16& b) {     \
    unsigned mask = 0;                                         \
    for (std::uint32_t i = 0; i < kReal16Lanes; ++i)           \
      mask |= unsigned(a.lanes[i] comparison b.lanes[i]) << i; \
    return mask;                                               \
  }
EXPHOTON_COMPARE(LessEqualMask, <=)
EXPHOTON_COMPARE(LessMask, <)
EXPHOTON_COMPARE(EqualMask, ==)
#undef EXPHOTON_COMPARE

inline void LoadOctahedral(const std::uint32_t* bits, Real16* a, Real16* b) {
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i) {
    const auto word = std::int32_t(bits[i]);
    a->lanes[i] = Real(std::int32_t(bits[i] << 16) >> 16);
    b->lanes[i] = Real(word >> 16);
  }
}

// Returns the lane with the smallest value among the lanes of the mask, which must not be 0. Ties
// go to the lowest lane.
inline unsigned NearestLane(const Real16& values, unsigned mask) {
  unsigned nearest = unsigned(__builtin_ctz(mask));
  for (unsigned rest = mask; rest != 0; rest &= rest - 1) {
    const auto lane = unsigned(__builtin_ctz(rest));
    nearest = values.lanes[lane] < values.lanes[nearest] ? lane : nearest;
  }
  return nearest;
}
// Returns the smallest value among the lanes of the mask. Values must not be negative. The result
// is unspecified if the mask is 0. Mask bits beyond the lanes are ignored.
inline Real LeastOf(const Real16& values, unsigned mask) {
  Real least = kInfinity;
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i)
    least = (mask >> i & 1) && values.lanes[i] < least ? values.lanes[i] : least;
  return least;
}

// Returns the largest value. Values must not be negative.
inline Real LargestOf(const Real16& values) {
  Real largest = 0;
  for (const Real lane : values.lanes) largest = lane > largest ? lane : largest;
  return largest;
}

inline std::size_t CountLessEqual(const Real16& a, const Real16& b) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i) count += a.lanes[i] <= b.lanes[i];
  return count;
}
// Returns a where a <= b, 0 elsewhere.
inline Real16 IfLessEqual(const Real16& a, const Real16& b) {
  Real16 r;
  for (std::uint32_t i = 0; i < kReal16Lanes; ++i)
    r.lanes[i] = a.lanes[i] <= b.lanes[i] ? a.lanes[i] : Real(0);
  return r;
}

// Writes the lanes of the mask contiguously and returns their number.
inline std::size_t StoreLanes(const Real16& values, unsigned mask, Real* to) {
  std::size_t count = 0;
  for (; mask != 0; mask &= mask - 1) to[count++] = values.lanes[__builtin_ctz(mask)];
  return count;
}
// These do the same for the lanes and their indices.
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
