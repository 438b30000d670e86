// SPDX-License-Identifier: BSD-2-Clause
// Real16 for the AVX-512 target uses one register. Lanes are compressed in registers and stored
// whole, because compressing stores are slow on some machines.

struct Real16 {
  __m512 v;

  static Real16 Load(const Real* row) { return {_mm512_load_ps(row)}; }
  static Real16 LoadUnaligned(const Real* row) { return {_mm512_loadu_ps(row)}; }
  static Real16 All(Real x) { return {_mm512_set1_ps(x)}; }
  void StoreUnaligned(Real* row) const { _mm512_storeu_ps(row, v); }
};

inline Real16 operator+(Real16 a, Real16 b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Real16 operator-(Real16 a, Real16 b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Real16 operator*(Real16 a, Real16 b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Real16 Min(Real16 a, Real16 b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Real16 Max(Real16 a, Real16 b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Real16 Sqrt(Real16 a) { return {_mm512_sqrt_ps(a.v)}; }
inline Real16 Abs(Real16 a) { return {_mm512_abs_ps(a.v)}; }
// Returns a, which must not be negative, with the sign of b.
inline Real16 CopySign(Real16 a, Real16 b) {
  const __m512i sign = _mm512_and_si512(_mm512_castps_si512(b.v), _mm512_set1_epi32(int(1u << 31)));
  return {_mm512_castsi512_ps(_mm512_or_si512(_mm512_castps_si512(a.v), sign))};
}
inline unsigned LessEqualMask(Real16 a, Real16 b) {
  return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ);
}
inline unsigned LessMask(Real16 a, Real16 b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
inline unsigned EqualMask(Real16 a, Real16 b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ); }

inline std::size_t CountLessEqual(Real16 a, Real16 b) {
  return unsigned(__builtin_popcount(LessEqualMask(a, b)));
}
// Returns a where a <= b, 0 elsewhere.
inline Real16 IfLessEqual(Real16 a, Real16 b) {
  return {_mm512_maskz_mov_ps(__mmask16(LessEqualMask(a, b)), a.v)};
}

inline void LoadOctahedral(const std::uint32_t* bits, Real16* a, Real16* b) {
  const __m512i words = _mm512_load_si512(bits);
  a->v = _mm512_cvtepi32_ps(_mm512_srai_epi32(_mm512_slli_epi32(words, 16), 16));
  b->v = _mm512_cvtepi32_ps(_mm512_srai_epi32(words, 16));
}

// Returns the lane with the smallest value among the lanes of the mask, which must not be 0. The
// last four bits of each value are replaced by its lane number and do not count. Values must not be
// negative, so that their bits have the same order as the values.
inline unsigned NearestLane(Real16 values, unsigned mask) {
  const __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i keys = _mm512_or_si512(
      _mm512_andnot_si512(_mm512_set1_epi32(15), _mm512_castps_si512(values.v)), places);
  return unsigned(_mm512_mask_reduce_min_epi32(__mmask16(mask), keys)) & 15;
}
// Returns the smallest value among the lanes of the mask. Values must not be negative. The result
// is unspecified if the mask is 0.
inline Real LeastOf(Real16 values, unsigned mask) {
  return std::bit_cast<Real>(
      _mm512_mask_reduce_min_epi32(__mmask16(mask), _mm512_castps_si512(values.v)));
}

// Returns the largest value. Values must not be negative.
inline Real LargestOf(Real16 values) {
  return std::bit_cast<Real>(_mm512_reduce_max_epi32(_mm512_castps_si512(values.v)));
}

// Writes the lanes of the mask contiguously and returns their number. It always writes sixteen
// values.
inline std::size_t StoreLanes(Real16 values, unsigned mask, Real* to) {
  _mm512_storeu_ps(to, _mm512_maskz_compress_ps(__mmask16(mask), values.v));
  return unsigned(__builtin_popcount(mask));
}
// Writes the lanes of the mask and their indices contiguously, and returns their number. It always
// writes sixteen values and indices.
inline std::size_t AppendLanes(Real16 values, std::uint32_t firstIndex, unsigned mask,
                               Real* distance2, std::uint32_t* index) {
  const __m512i places = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i indices = _mm512_add_epi32(_mm512_set1_epi32(int(firstIndex)), places);
  _mm512_storeu_ps(distance2, _mm512_maskz_compress_ps(__mmask16(mask), values.v));
  _mm512_storeu_si512(index, _mm512_maskz_compress_epi32(__mmask16(mask), indices));
  return unsigned(__builtin_popcount(mask));
}
// Does the same with the indices in `from`.
inline std::size_t KeepLanes(Real16 values, unsigned mask, const std::uint32_t* from,
                             Real* distance2, std::uint32_t* index) {
  const __m512i indices = _mm512_loadu_si512(from);
  _mm512_storeu_ps(distance2, _mm512_maskz_compress_ps(__mmask16(mask), values.v));
  _mm512_storeu_si512(index, _mm512_maskz_compress_epi32(__mmask16(mask), indices));
  return unsigned(__builtin_popcount(mask));
}
