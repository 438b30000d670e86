// SPDX-License-Identifier: BSD-2-Clause
// BuildBox and BvhItem hold the boxes that the BVH builder splits, as vectors of four whose last
// lane is unused. All operations round identically on every machine, so every machine builds the
// same tree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/math/bounds.h"

#if defined(__SSE2__) && !defined(EXPHOTON_DOUBLE)
#include <emmintrin.h>
#define EXPHOTON_BUILD_SSE2 1
#endif

namespace exphoton {

#if defined(EXPHOTON_BUILD_SSE2)

struct Real4 {
  __m128 v;

  static Real4 All(Real x) { return {_mm_set1_ps(x)}; }
  static Real4 Of(const Point3& p) { return {_mm_setr_ps(p.x, p.y, p.z, 0)}; }
  // The last lane becomes 0. It may hold the bits of an id, which as a float can be subnormal, and
  // subnormal numbers are slow to add.
  static Real4 Three(const Real* lanes) {
    const __m128 mask = _mm_castsi128_ps(_mm_setr_epi32(-1, -1, -1, 0));
    return {_mm_and_ps(_mm_load_ps(lanes), mask)};
  }
  void Store(Real* lanes) const { _mm_storeu_ps(lanes, v); }
  void Truncate(std::int32_t* lanes) const {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(lanes), _mm_cvttps_epi32(v));
  }
};
inline Real4 operator+(Real4 a, Real4 b) { return {_mm_add_ps(a.v, b.v)}; }
inline Real4 operator-(Real4 a, Real4 b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Real4 operator*(Real4 a, Real4 b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Real4 Min(Real4 a, Real4 b) { return {_mm_min_ps(a.v, b.v)}; }  // NaN: the second
inline Real4 Max(Real4 a, Real4 b) { return {_mm_max_ps(a.v, b.v)}; }

#else

struct Real4 {
  Real v[4];

  static Real4 All(Real x) { return {{x, x, x, x}}; }
  static Real4 Of(const Point3& p) { return {{p.x, p.y, p.z, 0}}; }
  static Real4 Three(const Real* lanes) { return {{lanes[0], lanes[1], lanes[2], 0}}; }
  void Store(Real* lanes) const { std::copy(v, v + 4, lanes); }
  void Truncate(std::int32_t* lanes) const {
    for (int i = 0; i < 4; ++i) lanes[i] = std::int32_t(v[i]);
  }
};
template <class Operation>
Real4 EachOf(const Real4& a, const Real4& b, const Operation& operation) {
  Real4 r;
  for (int i = 0; i < 4; ++i) r.v[i] = operation(a.v[i], b.v[i]);
  return r;
}
inline Real4 operator+(const Real4& a, const Real4& b) {
  return EachOf(a, b, [](Real x, Real y) { return x + y; });
}
inline Real4 operator-(const Real4& a, const Real4& b) {
  return EachOf(a, b, [](Real x, Real y) { return x - y; });
}
inline Real4 operator*(const Real4& a, const Real4& b) {
  return EachOf(a, b, [](Real x, Real y) { return x * y; });
}
inline Real4 Min(const Real4& a, const Real4& b) {
  return EachOf(a, b, [](Real x, Real y) { return x < y ? x : y; });
}
inline Real4 Max(const Real4& a, const Real4& b) {
  return EachOf(a, b, [](Real x, Real y) { return x > y ? x : y; });
}

#endif

struct BuildBox {
  Real4 low = Real4::All(kInfinity), high = Real4::All(-kInfinity);

  void Extend(const BuildBox& b) { low = Min(low, b.low), high = Max(high, b.high); }
  void Extend(Real4 p) { low = Min(low, p), high = Max(high, p); }
  // Halves each term first, so the sum never overflows.
  Real4 Middle() const { return low * Real4::All(Real(.5)) + high * Real4::All(Real(.5)); }
  Bounds3 ToBounds() const {
    Real a[4], b[4];
    low.Store(a), high.Store(b);
    Bounds3 bounds;
    bounds.min = {a[0], a[1], a[2]}, bounds.max = {b[0], b[1], b[2]};
    return bounds;
  }
};

// Returns half the surface area in double precision, which no finite single-precision box
// overflows.
inline double HalfArea(const Bounds3& box) {
  const double x = double(box.max.x) - double(box.min.x), y = double(box.max.y) - double(box.min.y),
               z = double(box.max.z) - double(box.min.z);
  return x * y + y * z + z * x;
}
inline double HalfArea(const BuildBox& box) { return HalfArea(box.ToBounds()); }

// BvhItem is one primitive of a run: its box, with the id in the spare fourth lane. It takes 32
// bytes in single precision.
struct alignas(4 * sizeof(Real)) BvhItem {
  Real low[3] = {kInfinity, kInfinity, kInfinity};
  std::uint32_t id = 0;
  Real high[3] = {-kInfinity, -kInfinity, -kInfinity};
  Real unused = 0;

  BvhItem() = default;
  BvhItem(const Bounds3& bounds, std::uint32_t number) : id(number) {
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = bounds.min[axis], high[axis] = bounds.max[axis];
  }
  // Returns the box including the margins.
  BuildBox Box() const { return {Real4::Three(low), Real4::Three(high)}; }
};

}  // namespace exphoton
