// SPDX-License-Identifier: BSD-2-Clause
// SampleSpecularRay: samples the ray of one specular lobe and propagates its ray differentials.
// Source: Igehy 1999, "Tracing Ray Differentials", section 3.
#include "core/transport/specular/specular_bounce.h"

namespace exphoton {
namespace {

// The bounce to differentiate. n is on the side of wo.
struct Bounce {
  Vector3 wo, wi;
  Normal3 n;
  Real eta;  // refractive index on wo's side over the index on wi's side; 0 for a reflection
};

// Returns the change of wi for a change dwo of wo and dn of n.
Vector3 DifferentialDirection(const Bounce& b, const Vector3& dwo, const Normal3& dn) {
  const Real cosO = Dot(b.wo, b.n);
  const Real dCosO = Dot(dwo, b.n) + Dot(b.wo, dn);
  if (b.eta == 0) return -dwo + Real(2) * (cosO * dn + dCosO * b.n);
  // wi = -eta wo + mu n with mu = eta cosO - cosT (Igehy, eqs. 14-17).
  const Real cosT = AbsDot(b.wi, b.n);
  const Real mu = b.eta * cosO - cosT;
  const Real dMu = (b.eta - b.eta * b.eta * cosO / cosT) * dCosO;
  return -b.eta * dwo + (mu * dn + dMu * b.n);
}

}  // namespace

// Grazing refraction divides by 0. Non-finite differentials are dropped.
void AddSpecularDifferentials(const ShadingPoint& point, const BsdfSample& sample,
                              RayDifferential* ray) {
  if (!point.ray.hasDifferentials) return;
  SurfaceInteraction surface = point.surface;
  if (!surface.hasDifferentials) surface.ComputeDifferentials(point.ray);
  if (!surface.hasDifferentials) return;

  const auto& shading = surface.shading;
  const Vector3& wo = surface.wo;
  // Bsdf::Sample reflects about the geometric normal if wo lies between the two normals.
  const bool isBetween = (Dot(wo, surface.ng) < 0) != (Dot(wo, shading.n) < 0);
  const bool usesNg = isBetween && !sample.IsTransmission();
  const Normal3& n = usesNg ? surface.ng : shading.n;
  const Normal3& dndu = usesNg ? surface.dndu : shading.dndu;
  const Normal3& dndv = usesNg ? surface.dndv : shading.dndv;
  const Real side = Dot(wo, n) < 0 ? Real(-1) : Real(1);
  const Bounce bounce{wo, sample.wi, side * n, sample.IsTransmission() ? sample.eta : 0};
  const Normal3 dndx = side * (dndu * surface.dudx + dndv * surface.dvdx);
  const Normal3 dndy = side * (dndu * surface.dudy + dndv * surface.dvdy);
  const Vector3 dwodx = -NormalizeOr(point.ray.xDirection, -wo) - wo;
  const Vector3 dwody = -NormalizeOr(point.ray.yDirection, -wo) - wo;

  ray->xOrigin = ray->o + surface.dpdx;
  ray->yOrigin = ray->o + surface.dpdy;
  ray->xDirection = ray->d + DifferentialDirection(bounce, dwodx, dndx);
  ray->yDirection = ray->d + DifferentialDirection(bounce, dwody, dndy);
  ray->hasDifferentials = IsFinite(ray->xOrigin) && IsFinite(ray->yOrigin) &&
                          IsFinite(ray->xDirection) && IsFinite(ray->yDirection);
}

std::optional<SpecularRay> SampleSpecularRay(const ShadingPoint& point, LobeSet lobes, Point2 u,
                                             Real uLobe) {
  const std::optional<BsdfSample> sample =
      point.bsdf.Sample(point.Wo(), u, uLobe, lobes & LobeSet::Specular);
  if (!sample || sample->throughput.IsBlack() || !sample->throughput.IsFinite()) {
    return std::nullopt;
  }
  SpecularRay result;
  result.ray = SpawnRay(point.surface, sample->wi);
  result.throughput = sample->throughput;
  AddSpecularDifferentials(point, *sample, &result.ray);
  return result;
}

}  // namespace exphoton
