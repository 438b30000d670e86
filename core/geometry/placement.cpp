// SPDX-License-Identifier: BSD-2-Clause
// Placement scales areas and solid angles by a linear map M. AreaScale is |det M| |M^-T n|. With K
// = M^-1, SolidAngleScale is |det K| / |K w|^3.
#include "core/geometry/placement.h"

#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

// Returns the derivative of the transformed unit normal, given the normal `n` and its derivative
// `dn`.
Normal3 ApplyNormalDerivative(const Transform& transform, const Normal3& n, const Normal3& dn) {
  const Vec3d image(transform.ApplyNormal(n)), derivative(transform.ApplyNormal(dn));
  const double length = Length(image);
  if (!(length > 0)) return {};
  const Vec3d unit = image * (1 / length);
  return ((derivative - unit * Dot(unit, derivative)) * (1 / length)).ToReal();
}

// Returns the tangent's part across the unit vector n, as long as the tangent.
Vector3 Across(const Normal3& n, const Vector3& tangent) {
  const Vec3d normal(n), all(tangent);
  const Vec3d flat = all - normal * Dot(normal, all);
  const double length = Length(flat), whole = Length(all);
  if (!(length > 1e-6 * whole)) return Frame::FromZ(n).x * Real(whole);
  return (flat * (whole / length)).ToReal();
}

// Returns the length of the product of a 3x3 matrix with a vector, in double.
template <class Entry>
double LengthOf(const Vec3& v, const Entry& entry) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double x =
        entry(i, 0) * double(v.x) + entry(i, 1) * double(v.y) + entry(i, 2) * double(v.z);
    sum += x * x;
  }
  return std::sqrt(sum);
}

}  // namespace

Ray RayToLocal(const Transform& toLocal, const Ray& ray, Real tMax) {
  Ray local = ray;
  local.o = toLocal.ApplyPoint(ray.o);
  local.d = toLocal.ApplyVector(ray.d);
  local.tMax = tMax;
  return local;
}

SurfacePoint PointToLocal(const Transform& toLocal, const SurfacePoint& point) {
  SurfacePoint local;
  local.p = toLocal.ApplyPoint(point.p, point.pError, &local.pError);
  local.ng = NormalizeOr(toLocal.ApplyNormal(point.ng), Normal3());
  local.time = point.time;
  return local;
}

SurfacePoint PointToWorld(const Transform& toWorld, const SurfacePoint& local) {
  SurfacePoint point;
  const Vector3 error = local.pError + Abs(local.p) * Gamma(3);
  point.p = toWorld.ApplyPoint(local.p, error, &point.pError);
  point.ng = NormalizeOr(toWorld.ApplyNormal(local.ng), local.ng);
  point.time = local.time;
  return point;
}

SurfaceInteraction SurfaceToWorld(const Transform& toWorld, const SurfaceInteraction& local) {
  SurfaceInteraction surface = local;
  static_cast<SurfacePoint&>(surface) = PointToWorld(toWorld, local);
  surface.dpdu = toWorld.ApplyVector(local.dpdu);
  surface.dpdv = toWorld.ApplyVector(local.dpdv);
  surface.dndu = ApplyNormalDerivative(toWorld, local.ng, local.dndu);
  surface.dndv = ApplyNormalDerivative(toWorld, local.ng, local.dndv);
  const auto& shading = local.shading;
  const Normal3 n = NormalizeOr(toWorld.ApplyNormal(shading.n), surface.ng);
  // A stretch can take an interpolated normal to the other side of ng. It is turned back, and its
  // derivatives with it.
  const Real side = Dot(n, surface.ng) < 0 ? -1 : 1;
  surface.shading.n = n * side;
  surface.shading.dpdu = toWorld.ApplyVector(shading.dpdu);
  surface.shading.dpdv = toWorld.ApplyVector(shading.dpdv);
  if (side < 0) {  // with these tangents the turned normal would have the wrong hand
    surface.shading.dpdu = Across(n, surface.dpdu);
    surface.shading.dpdv = Across(n, surface.dpdv);
  }
  surface.shading.dndu = ApplyNormalDerivative(toWorld, shading.n, shading.dndu) * side;
  surface.shading.dndv = ApplyNormalDerivative(toWorld, shading.n, shading.dndv) * side;
  return surface;
}

Real AreaScale(const Transform& toWorld, const Normal3& ng) {
  const auto& inverse = toWorld.InverseMatrix().m;
  const double length = LengthOf(ng, [&](std::size_t i, std::size_t j) { return inverse[j][i]; });
  return Real(toWorld.VolumeScale() * length);
}

Real SolidAngleScale(const Transform& toWorld, const Vector3& w) {
  const auto& inverse = toWorld.InverseMatrix().m;
  const double length = LengthOf(w, [&](std::size_t i, std::size_t j) { return inverse[i][j]; });
  const double scale = 1 / (toWorld.VolumeScale() * length * length * length);
  return std::isfinite(scale) ? Real(scale) : Real(0);
}

}  // namespace exphoton
