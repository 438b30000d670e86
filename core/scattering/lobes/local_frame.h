// SPDX-License-Identifier: BSD-2-Clause
// Small helpers for directions in a lobe's local frame, where z is the shading normal.
#pragma once

#include <optional>

#include "core/math/vec.h"

namespace exphoton {

// Strictly on the same side of the surface; a direction in the surface is on neither side. By
// comparisons, since a product of two tiny cosines underflows.
constexpr bool SameHemisphere(const Vector3& a, const Vector3& b) {
  return (a.z > 0 && b.z > 0) || (a.z < 0 && b.z < 0);
}
constexpr Vector3 MirrorZ(const Vector3& v) { return {v.x, v.y, -v.z}; }
// v, or its mirror image on the side where `side` is (+z for side.z == 0).
constexpr Vector3 OnSideOf(const Vector3& v, const Vector3& side) {
  return (v.z < 0) != (side.z < 0) ? MirrorZ(v) : v;
}

// The half vector of two directions on one side, on that side too, and its cosine to both:
// |wo + wi| / 2, which cancels less than a dot product where they are nearly opposite. nullopt
// where they are on no common side or exactly opposite.
struct HalfVector {
  Vector3 h;
  Real cosine;  // wo.h = wi.h > 0

  static std::optional<HalfVector> Of(const Vector3& wo, const Vector3& wi) {
    if (!SameHemisphere(wo, wi)) return std::nullopt;
    const Vector3 sum = wo + wi;
    const Real length = Length(sum);
    if (!(length > std::sqrt(std::numeric_limits<Real>::min()))) return std::nullopt;
    return HalfVector{sum / length, std::min(length / 2, Real(1))};
  }
};

}  // namespace exphoton
