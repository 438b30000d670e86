// SPDX-License-Identifier: BSD-2-Clause
// Real16 for the AVX2 target uses two registers. A table of permutations compresses lanes.

struct Real16 {
  __m256 low, high;

  static Real16 Load(const Real* row) { return {_mm256_load_ps(row), _mm256_load_ps(row + 8)}; }
  static Real16 LoadUnaligned(const Real* row) {
    return {_mm256_loadu_ps(row), _mm256_loadu_ps(row + 8)};
  }
  static Real16 All(Real x) { return {_mm256_set1_ps(x), _mm256_set1_ps(x)}; }
  void StoreUnaligned(Real* row) const {
    _mm256_storeu_ps(row, low);
    _mm256_storeu_ps(row + 8, high);
  }
};

#define EXPHOTON_HALVES(name, operation)                         \
  inline Real16 name(Real16 a, Real16 b) {                       \
    return {operation(a.low, b.low), operation(a.high, b.high)}; \
  }
EXPHOTON_HALVES(operator+, _mm256_add_ps)
EXPHOTON_HALVES(operator-, _mm256_sub_ps)
EXPHOTON_HALVES(operator*, _mm256_mul_ps)
EXPHOTON_HALVES(Min, _mm256_min_ps)
EXPHOTON_HALVES(Max, _mm256_max_ps)
#undef EXPHOTON_HALVES
inline Real16 Sqrt(Real16 a) { return {_mm256_sqrt_ps(a.low), _mm256_sqrt_ps(a.high)}; }
inline Real16 Abs(Real16 a) {
  const __m256 sign = _mm256_set1_ps(Real(-0.));
  return {_mm256_andnot_ps(sign, a.low), _mm256_andnot_ps(sign, a.high)};
}
// Returns a, which must not be negative, with the sign of b.
inline Real16 CopySign(Real16 a, Real16 b) {
  const __m256 sign = _mm256_set1_ps(Real(-0.));
  return {_mm256_or_ps(a.low, _mm256_and_ps(sign, b.low)),
          _mm256_or_ps(a.high, _mm256_and_ps(sign, b.high))};
}
template <int kPredicate>
inline unsigned CompareMask(Real16 a, Real16 b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.low, b.low, kPredicate))) |
         unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.high, b.high, kPredicate))) << 8;
}
inline unsigned LessEqualMask(Real16 a, Real16 b) { return CompareMask<_CMP_LE_OQ>(a, b); }
inline unsigned LessMask(Real16 a, Real16 b) { return CompareMask<_CMP_LT_OQ>(a, b); }
inline unsigned EqualMask(Real16 a, Real16 b) { return CompareMask<_CMP_EQ_OQ>(a, b); }

inline __m256 UpperHalves(__m256i words) {
  return _mm256_cvtepi32_ps(_mm256_srai_epi32(words, 16));
}
inline std::size_t CountLessEqual(Real16 a, Real16 b) {
  return unsigned(__builtin_popcount(LessEqualMask(a, b)));
}
// Returns a where a <= b, 0 elsewhere.
inline Real16 IfLessEqual(Real16 a, Real16 b) {
  return {_mm256_and_ps(a.low, _mm256_cmp_ps(a.low, b.low, _CMP_LE_OQ)),
          _mm256_and_ps(a.high, _mm256_cmp_ps(a.high, b.high, _CMP_LE_OQ))};
}

inline void LoadOctahedral(const std::uint32_t* bits, Real16* a, Real16* b) {
  const auto* words = reinterpret_cast<const __m256i*>(bits);
  const __m256i low = _mm256_load_si256(words), high = _mm256_load_si256(words + 1);
  *a = {UpperHalves(_mm256_slli_epi32(low, 16)), UpperHalves(_mm256_slli_epi32(high, 16))};
  *b = {UpperHalves(low), UpperHalves(high)};
}

// Expands the eight mask bits from `from` to eight lanes of all ones or all zeros.
inline __m256i LanesOf(unsigned mask, int from) {
  const __m256i bit = _mm256_slli_epi32(_mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128), from);
  return _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(int(mask)), bit), bit);
}
inline std::int32_t LeastOfEight(__m256i v) {
  __m128i least = _mm_min_epi32(_mm256_castsi256_si128(v), _mm256_extracti128_si256(v, 1));
  least = _mm_min_epi32(least, _mm_shuffle_epi32(least, 0x4e));
  return _mm_cvtsi128_si32(_mm_min_epi32(least, _mm_shuffle_epi32(least, 0xb1)));
}
// Returns the smallest key, signed, among the lanes of the mask.
inline std::int32_t LeastKey(__m256i low, __m256i high, unsigned mask) {
  const __m256i none = _mm256_set1_epi32(std::numeric_limits<std::int32_t>::max());
  return LeastOfEight(_mm256_min_epi32(_mm256_blendv_epi8(none, low, LanesOf(mask, 0)),
                                       _mm256_blendv_epi8(none, high, LanesOf(mask, 8))));
}
// Returns the lane with the smallest value among the lanes of the mask, which must not be 0. The
// last four bits of each value are replaced by its lane number and do not count. Values must not be
// negative, so that their bits have the same order as the values.
inline unsigned NearestLane(Real16 values, unsigned mask) {
  const __m256i places = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  const __m256i low4 = _mm256_set1_epi32(15);
  const auto key = [&](__m256 v, int from) {
    return _mm256_or_si256(_mm256_andnot_si256(low4, _mm256_castps_si256(v)),
                           _mm256_add_epi32(places, _mm256_set1_epi32(from)));
  };
  return unsigned(LeastKey(key(values.low, 0), key(values.high, 8), mask)) & 15;
}
// Returns the smallest value among the lanes of the mask. Values must not be negative. The result
// is unspecified if the mask is 0.
inline Real LeastOf(Real16 values, unsigned mask) {
  return std::bit_cast<Real>(
      LeastKey(_mm256_castps_si256(values.low), _mm256_castps_si256(values.high), mask));
}

// Returns the largest value. Values must not be negative.
inline Real LargestOf(Real16 values) {
  const __m256 eight = _mm256_max_ps(values.low, values.high);
  __m128 largest = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
  largest = _mm_max_ps(largest, _mm_movehl_ps(largest, largest));
  return _mm_cvtss_f32(_mm_max_ss(largest, _mm_shuffle_ps(largest, largest, 1)));
}

// For each 8-bit mask, this table lists the lanes of the mask in order.
constexpr auto kCompress = [] {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned mask = 0; mask < 256; ++mask)
    for (std::uint8_t lane = 0, at = 0; lane < 8; ++lane)
      if (mask >> lane & 1) table[mask][at++] = lane;
  return table;
}();

inline __m256i OrderOf(unsigned mask) {
  return _mm256_cvtepu8_epi32(
      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kCompress[mask].data())));
}
// Writes the lanes of the mask contiguously and returns their number. It may write up to sixteen
// values.
inline std::size_t StoreLanes(Real16 values, unsigned mask, Real* to) {
  const unsigned first = mask & 0xff, second = mask >> 8;
  const auto count = unsigned(__builtin_popcount(first));
  _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(values.low, OrderOf(first)));
  _mm256_storeu_ps(to + count, _mm256_permutevar8x32_ps(values.high, OrderOf(second)));
  return count + unsigned(__builtin_popcount(second));
}

inline void KeepEight(__m256 values, __m256i indices, unsigned mask, Real* distance2,
                      std::uint32_t* index) {
  const __m256i order = OrderOf(mask);
  _mm256_storeu_ps(distance2, _mm256_permutevar8x32_ps(values, order));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(index),
                      _mm256_permutevar8x32_epi32(indices, order));
}
inline std::size_t KeepSixteen(Real16 values, __m256i low, __m256i high, unsigned mask,
                               Real* distance2, std::uint32_t* index) {
  const unsigned first = mask & 0xff, second = mask >> 8;
  const auto count = unsigned(__builtin_popcount(first));
  KeepEight(values.low, low, first, distance2, index);
  KeepEight(values.high, high, second, distance2 + count, index + count);
  return count + unsigned(__builtin_popcount(second));
}
// Writes the lanes of the mask and their indices contiguously, and returns their number. It may
// write up to sixteen values and indices.
inline std::size_t AppendLanes(Real16 values, std::uint32_t firstIndex, unsigned mask,
                               Real* distance2, std::uint32_t* index) {
  const __m256i places = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  return KeepSixteen(values, _mm256_add_epi32(places, _mm256_set1_epi32(int(firstIndex))),
                     _mm256_add_epi32(places, _mm256_set1_epi32(int(firstIndex + 8))), mask,
                     distance2, index);
}
// Does the same with the indices in `from`.
inline std::size_t KeepLanes(Real16 values, unsigned mask, const std::uint32_t* from,
                             Real* distance2, std::uint32_t* index) {
  const auto* indices = reinterpret_cast<const __m256i*>(from);
  return KeepSixteen(values, _mm256_loadu_si256(indices), _mm256_loadu_si256(indices + 1), mask,
                     distance2, index);
}
