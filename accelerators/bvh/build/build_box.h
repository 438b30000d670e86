// SPDX-License-Identifier: BSD-2-Clause
// BuildBox and BvhItem hold the boxes that the BVH builder splits, as vectors of four whose last
// lane is unused. All operations round identically on every machine, so every machine builds the
// same tree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/math/bounds.h"

namespace exphoton {

// Real4 is a vector of the compiler's own vector extension, which every architecture has. It needs
// no instructions beyond the baseline and can be inlined everywhere, so it is no SIMD kernel.
struct Real4 {
  using Vector __attribute__((vector_size(4 * sizeof(Real)))) = Real;
  using Bits __attribute__((vector_size(4 * sizeof(Real)))) =
      std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;
  using Integers __attribute__((vector_size(4 * sizeof(std::int32_t)))) = std::int32_t;

  Vector v;

  static Real4 All(Real x) { return {Vector{x, x, x, x}}; }
  static Real4 Of(const Point3& p) { return {Vector{p.x, p.y, p.z, 0}}; }
  // The last lane becomes 0. It may hold the bits of an id, which as a float can be subnormal, and
  // subnormal numbers are slow to add.
  static Real4 Three(const Real* lanes) {
    Bits bits;
    std::memcpy(&bits, lanes, sizeof(bits));
    return {Vector(bits & Bits{-1, -1, -1, 0})};
  }
  void Store(Real* lanes) const { std::memcpy(lanes, &v, sizeof(v)); }
  void Truncate(std::int32_t* lanes) const {
    const Integers integers = __builtin_convertvector(v, Integers);
    std::memcpy(lanes, &integers, sizeof(integers));
  }
};
inline Real4 operator+(const Real4& a, const Real4& b) { return {a.v + b.v}; }
inline Real4 operator-(const Real4& a, const Real4& b) { return {a.v - b.v}; }
inline Real4 operator*(const Real4& a, const Real4& b) { return {a.v * b.v}; }
inline Real4 Min(const Real4& a, const Real4& b) { return {a.v < b.v ? a.v : b.v}; }
inline Real4 Max(const Real4& a, const Real4& b) { return {a.v > b.v ? a.v : b.v}; }

struct BuildBox {
  Real4 low = Real4::All(kInfinity), high = Real4::All(-kInfinity);

  void Extend(const BuildBox& b) { low = Min(low, b.low), high = Max(high, b.high); }
  void Extend(Real4 p) { low = Min(low, p), high = Max(high, p); }
  // Halves each term first, so the sum never overflows.
  Real4 Center() const { return low * Real4::All(Real(.5)) + high * Real4::All(Real(.5)); }
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
