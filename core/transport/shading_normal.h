// SPDX-License-Identifier: BSD-2-Clause
// ShadingNormalFactor is the adjoint correction for shading normals (Veach 1997, section 5.3).
// Scattering with an interpolated or bumped normal is not symmetric. Photon paths apply this
// factor; camera paths do not. CosineRatio relates the light on a surface with one normal to the
// light on a surface with another.
#pragma once

#include "core/math/vec.h"

namespace exphoton {

// Returns |wo.ns| |wi.ng| / (|wo.ng| |wi.ns|). wo points to the photon's previous vertex, wi to its
// next. Returns 0 if a cosine in the denominator is 0, and at most kMaxShadingNormalFactor.
inline constexpr Real kMaxShadingNormalFactor = 100;
inline Real ShadingNormalFactor(const Vector3& wo, const Vector3& wi, const Normal3& ng,
                                const Normal3& ns) {
  if (ng == ns) return 1;
  const Real denominator = AbsDot(wo, ng) * AbsDot(wi, ns);
  if (!(denominator > 0)) return 0;
  return std::min(AbsDot(wo, ns) * AbsDot(wi, ng) / denominator, kMaxShadingNormalFactor);
}

// Returns |w.n| / |w.base|. Returns 0 if the denominator is 0, and at most kMaxShadingNormalFactor.
inline Real CosineRatio(const Vector3& w, const Normal3& n, const Normal3& base) {
  if (n == base) return 1;
  const Real denominator = AbsDot(w, base);
  if (!(denominator > 0)) return 0;
  return std::min(AbsDot(w, n) / denominator, kMaxShadingNormalFactor);
}

}  // namespace exphoton
