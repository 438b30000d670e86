// SPDX-License-Identifier: BSD-2-Clause
// ComputeDifferentials finds the pixel footprint on the surface. It intersects the neighbouring
// rays with the tangent plane and converts the steps to u and v. Source: Igehy 1999, "Tracing Ray
// Differentials".
#include "core/geometry/interaction.h"

#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

// Returns the step from `p` to the point where a neighbouring ray meets the plane through p. The
// result is not finite if the ray is parallel to the plane.
Vec3d StepOnPlane(const Vec3d& p, const Vec3d& normal, const Point3& origin,
                  const Vector3& direction) {
  const Vec3d toPlane = p - Vec3d(origin);
  const Vec3d d(direction);
  const double denominator = Dot(normal, d);
  if (denominator == 0) {
    const double infinity = std::numeric_limits<double>::infinity();
    return {infinity, infinity, infinity};
  }
  return d * (Dot(normal, toPlane) / denominator) - toPlane;
}

// TangentBasis computes the coordinates of a tangent-plane vector in the basis (dpdu, dpdv). It
// uses the two axes on which the projection of the plane is largest. The test for a degenerate
// basis is relative to its size.
struct TangentBasis {
  int a, b;
  double ua, ub, va, vb, determinant;

  TangentBasis(const Normal3& n, const Vector3& dpdu, const Vector3& dpdv) {
    const int dropped = MaxDimension(Abs(n));
    a = (dropped + 1) % 3, b = (dropped + 2) % 3;
    ua = dpdu[a], ub = dpdu[b], va = dpdv[a], vb = dpdv[b];
    determinant = ua * vb - ub * va;
    const double size = std::hypot(ua, ub) * std::hypot(va, vb);
    if (std::abs(determinant) <= 1e-9 * size) determinant = 0;
  }
  Point2 Solve(const Vec3d& step) const {
    if (determinant == 0) return {};
    return {Real((step[a] * vb - step[b] * va) / determinant),
            Real((ua * step[b] - ub * step[a]) / determinant)};
  }
};

}  // namespace

void SurfaceInteraction::ComputeDifferentials(const RayDifferential& ray) {
  hasDifferentials = false;
  dpdx = dpdy = Vector3();
  dudx = dvdx = dudy = dvdy = 0;
  if (!ray.hasDifferentials) return;

  const Vec3d origin(p), normal(ng);
  const Vec3d stepX = StepOnPlane(origin, normal, ray.xOrigin, ray.xDirection);
  const Vec3d stepY = StepOnPlane(origin, normal, ray.yOrigin, ray.yDirection);
  const TangentBasis basis(ng, dpdu, dpdv);
  const Vector3 worldX = stepX.ToReal(), worldY = stepY.ToReal();
  const Point2 uvX = basis.Solve(stepX), uvY = basis.Solve(stepY);
  if (!IsFinite(worldX) || !IsFinite(worldY) || !std::isfinite(uvX.x + uvX.y) ||
      !std::isfinite(uvY.x + uvY.y)) {
    return;
  }
  hasDifferentials = true;
  dpdx = worldX, dpdy = worldY;
  dudx = uvX.x, dvdx = uvX.y;
  dudy = uvY.x, dvdy = uvY.y;
}

}  // namespace exphoton
