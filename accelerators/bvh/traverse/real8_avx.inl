// SPDX-License-Identifier: BSD-2-Clause
// Real8 and PlaceOrder are common to the AVX2 and AVX-512 traversals: eight Reals in a register,
// and the reading of child orders. The file is included into an unnamed namespace where these
// instructions are enabled.

struct Real8 {
  __m256 v;

  static Real8 Load(const Real* row) { return {_mm256_load_ps(row)}; }
  static Real8 All(Real x) { return {_mm256_set1_ps(x)}; }
  void Store(Real* row) const { _mm256_storeu_ps(row, v); }
};

inline Real8 operator/(Real8 a, Real8 b) { return {_mm256_div_ps(a.v, b.v)}; }
inline Real8 operator+(Real8 a, Real8 b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Real8 operator-(Real8 a, Real8 b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Real8 operator*(Real8 a, Real8 b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Real8 MultiplyAdd(Real8 a, Real8 b, Real8 c) { return {_mm256_fmadd_ps(a.v, b.v, c.v)}; }
inline Real8 Abs(Real8 a) { return {_mm256_andnot_ps(_mm256_set1_ps(Real(-0.)), a.v)}; }
inline Real8 Min(Real8 a, Real8 b) { return {_mm256_min_ps(a.v, b.v)}; }  // NaN: the second
inline Real8 Max(Real8 a, Real8 b) { return {_mm256_max_ps(a.v, b.v)}; }

constexpr bool kHitsInSingle = kAcceptsSinglePrecision;

// Tests IsTraceable for the origin and the direction in one register.
inline bool IsWorthTracing(const Ray& ray) {
  static_assert(offsetof(Ray, o) == 0 && offsetof(Ray, d) == 12 && sizeof(Ray) >= 32);
  const __m256 components = _mm256_loadu_ps(reinterpret_cast<const float*>(&ray));
  const __m256 sizes = _mm256_andnot_ps(_mm256_set1_ps(Real(-0.)), components);
  const __m256i bits = _mm256_castps_si256(sizes);  // ordered like the floats, NaN last
  const __m256i isFinite =
      _mm256_cmpgt_epi32(_mm256_castps_si256(_mm256_set1_ps(kInfinity)), bits);
  const __m256i isNotZero = _mm256_cmpgt_epi32(bits, _mm256_setzero_si256());
  const auto finite = unsigned(_mm256_movemask_ps(_mm256_castsi256_ps(isFinite)));
  const auto notZero = unsigned(_mm256_movemask_ps(_mm256_castsi256_ps(isNotZero)));
  return (finite & 0x3f) == 0x3f && (notZero & 0x38) != 0 && ray.tMax > 0;
}

// Lanes 0 to 2 are the axes. The other lanes hold 1, so division by them is safe.
using Axes = Real8;
inline Axes AxesOf(const Vec3& a) { return {_mm256_setr_ps(a.x, a.y, a.z, 1, 1, 1, 1, 1)}; }
inline Real8 AllOf(Axes a, int axis) {
  return {_mm256_permutevar8x32_ps(a.v, _mm256_set1_epi32(axis))};
}

// PlaceOrder reads an order from its end to its beginning, so that the nearest child comes last, on
// top of the stack. For the opposite direction it reads from the beginning to the end.
class PlaceOrder {
 public:
  explicit PlaceOrder(bool isOpposite)
      : shifts_(isOpposite ? _mm256_setr_epi32(0, 4, 8, 12, 16, 20, 24, 28)
                           : _mm256_setr_epi32(28, 24, 20, 16, 12, 8, 4, 0)),
        flip_(isOpposite ? 0 : 28) {}

  // Returns the lane at each place in the three low bits. Permutations ignore the other bits.
  __m256i Lanes(BvhOrder order) const {
    return _mm256_srlv_epi32(_mm256_set1_epi32(int(order)), shifts_);
  }
  // Returns the lane at the last place in a mask, which must not be 0.
  unsigned LastLane(BvhOrder order, unsigned places) const {
    const unsigned last = 4 * unsigned(std::bit_width(places)) - 4;
    return order >> (last ^ flip_) & 7;
  }

 private:
  __m256i shifts_;
  unsigned flip_;
};
