// SPDX-License-Identifier: BSD-2-Clause
// The kernel of ReprojectedCell is one loop that the compiler vectorises for each SIMD target. It
// has no branches and no selects.
#include "integrators/photon/gather/reprojected_cell.h"

#include <cmath>

#include "core/math/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "integrators/photon/gather/reprojected_cell_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace exphoton::HWY_NAMESPACE {

void Reproject(const GuideCacheCell& cell, const Vector3& from, const LitSide& side,
               ReprojectedCell* view) {
  constexpr Real kNowhere = Real(2e-19);  // avoids 0 / 0 for an origin at p; changes no other
  const Real *const x = cell.X(), *const y = cell.Y(), *const z = cell.Z();
  Real *const wx = view->x, *const wy = view->y, *const wz = view->z, *const cosine = view->cosine;
  const Vector3 p = from;
  const Normal3 ng = side.ng, ns = side.ns;
  const Real horizon = side.isTwoSided ? -2 : 0;  // a one-sided surface ignores light from below
  const std::size_t count = cell.size();
  int lit = 0;
  EXPHOTON_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const Real dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z + kNowhere;
    const Real inverse = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
    wx[i] = dx * inverse, wy[i] = dy * inverse, wz[i] = dz * inverse;
    const Real geometric = wx[i] * ng.x + wy[i] * ng.y + wz[i] * ng.z;
    const Real shading = wx[i] * ns.x + wy[i] * ns.y + wz[i] * ns.z;
    const int isLit = (geometric > horizon) & (shading > horizon);
    cosine[i] = std::abs(shading) + Real(1 - isLit) * (2 * ReprojectedCell::kUnlit);
    lit += isLit;
  }
  view->lit = lit;
}

}  // namespace exphoton::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace exphoton {

std::span<const ReprojectedCell::Kernel> ReprojectedCell::Kernels() {
  static constexpr Kernel kAll[] = EXPHOTON_SIMD_TARGETS(Reproject);
  return {kAll, UsableSimdTargets()};
}

ReprojectedCell::ReprojectedCell(const GuideCacheCell& cell, const Point3& p, const LitSide& side,
                                 Arena* arena)
    : x(arena->AllocateArray<Real>(4 * cell.RowLength())),
      y(x + cell.RowLength()),
      z(y + cell.RowLength()),
      cosine(z + cell.RowLength()) {
  static const Kernel look = Kernels().back();
  look(cell, p - cell.Center(), side, this);
  for (std::size_t i = cell.size(); i < cell.RowLength(); ++i) x[i] = y[i] = z[i] = cosine[i] = 0;
}

}  // namespace exphoton
#endif
