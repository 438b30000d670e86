// SPDX-License-Identifier: BSD-2-Clause
// ApplyBump uses forward differences. With q = p + d(u,v) n: dq/du = dp/du + dd/du n + d dn/du.
#include "core/scattering/bump.h"

namespace exphoton {
namespace {

Real StepOf(Real alongX, Real alongY) {
  const Real step = (std::abs(alongX) + std::abs(alongY)) / 2;
  return step > 0 && std::isfinite(step) ? step : Real(.01);
}

// Returns the interaction moved by a step of u (or v) along the surface.
SurfaceInteraction Moved(const SurfaceInteraction& si, const Vector3& dp, const Normal3& dn,
                         Real du, Real dv) {
  SurfaceInteraction moved = si;
  const Real step = du + dv;  // one of them is 0
  moved.p = si.p + dp * step;
  moved.uv = si.uv + Point2(du, dv);
  moved.shading.n = NormalizeOr(si.shading.n + dn * step, si.shading.n);
  return moved;
}

}  // namespace

void ApplyBump(const Texture<Real>& displacement, SurfaceInteraction* si) {
  const SurfaceInteraction::Shading& old = si->shading;
  const Real du = StepOf(si->dudx, si->dudy), dv = StepOf(si->dvdx, si->dvdy);
  const Real here = displacement.Evaluate(*si);
  const Real atU = displacement.Evaluate(Moved(*si, old.dpdu, old.dndu, du, 0));
  const Real atV = displacement.Evaluate(Moved(*si, old.dpdv, old.dndv, 0, dv));

  const Vector3 dpdu = old.dpdu + old.n * ((atU - here) / du) + old.dndu * here;
  const Vector3 dpdv = old.dpdv + old.n * ((atV - here) / dv) + old.dndv * here;
  if (!IsFinite(dpdu) || !IsFinite(dpdv)) return;
  const Normal3 n = NormalizeOr(Cross(dpdu, dpdv), Normal3());
  if (n == Normal3()) return;
  si->shading.dpdu = dpdu;
  si->shading.dpdv = dpdv;
  si->shading.n = FaceForward(n, si->ng);
}

}  // namespace exphoton
