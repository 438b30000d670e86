// SPDX-License-Identifier: BSD-2-Clause
// These helpers work on directions in a lobe's local frame, where z is the shading normal.
#pragma once

#include <optional>

#include "core/math/vec.h"

namespace exphoton {

// Returns whether both directions are strictly on the same side of the surface. A direction in the
// surface is on neither side. The signs are compared, because a product of two tiny cosines
// underflows.
constexpr bool SameHemisphere(const Vector3& a, const Vector3& b) {
  return (a.z > 0 && b.z > 0) || (a.z < 0 && b.z < 0);
}
constexpr Vector3 MirrorZ(const Vector3& v) { return {v.x, v.y, -v.z}; }
// Returns v, mirrored if necessary to the side of `side` (+z for side.z == 0).
constexpr Vector3 OnSideOf(const Vector3& v, const Vector3& side) {
  return (v.z < 0) != (side.z < 0) ? MirrorZ(v) : v;
}

// HalfVector is the half vector of two directions on one side of the surface, with its cosine to
// both. The half vector is on this side too. The cosine is |wo + wi| / 2, which cancels less than a
// dot product for nearly opposite directions. `Of` returns nullopt for directions on no common side
// or exactly opposite.
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
