// SPDX-License-Identifier: BSD-2-Clause
// TrianglePoint computes the point where a triangle was hit. It is the first part of the surface
// record, inline for callers that need no more.
#pragma once

#include "core/geometry/ray.h"
#include "core/geometry/vec3d.h"

namespace exphoton {

// Returns the point at barycentrics (b1, b2). The normal follows the winding p0, p1, p2.
inline SurfacePoint TrianglePoint(const Vec3d& p0, const Vec3d& p1, const Vec3d& p2, Real b1,
                                  Real b2) {
  SurfacePoint point;
  // Weights that sum to 1 keep the point in the plane, whatever their own error. The remaining
  // error is one rounding to Real and the roundings of the sum.
  const double w1 = double(b1), w2 = double(b2), w0 = 1 - w1 - w2;
  const Vec3d p = p0 * w0 + p1 * w1 + p2 * w2;
  point.p = p.ToReal();
  for (int axis = 0; axis < 3; ++axis) {
    const double magnitude = std::abs(p0[axis]) + std::abs(p1[axis]) + std::abs(p2[axis]);
    point.pError[axis] = Real(double(Gamma(2)) * std::abs(p[axis]) + 2e-15 * magnitude);
  }
  point.ng = NormalizeOrZero(Cross(p1 - p0, p2 - p0)).ToReal();
  return point;
}

}  // namespace exphoton
