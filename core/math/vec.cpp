// SPDX-License-Identifier: BSD-2-Clause
// NormalizeExtremeOr normalises vectors of extreme length without underflow or overflow.
#include "core/math/vec.h"

namespace exphoton {

Vec3 NormalizeExtremeOr(const Vec3& a, const Vec3& fallback) {
  const Real largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  if (!(largest > 0) || !IsFinite(a)) return fallback;
  int exponent;
  std::frexp(largest, &exponent);
  const Vec3 b(std::ldexp(a.x, -exponent), std::ldexp(a.y, -exponent), std::ldexp(a.z, -exponent));
  return b / Length(b);
}

}  // namespace exphoton
