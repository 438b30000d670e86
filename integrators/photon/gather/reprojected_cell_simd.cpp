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

void Reproject(const GuideCell& cell, const Vector3& shadingPoint, const LitSide& side,
               ReprojectedCell* view) {
  // Avoids 0 / 0 for a photon whose origin is the shading point. It is too small to change others.
  constexpr Real kTiny = Real(2e-19);
  const Real *const x = cell.X(), *const y = cell.Y(), *const z = cell.Z();
  Real *const wx = view->x, *const wy = view->y, *const wz = view->z, *const cosine = view->cosine;
  // Copies, because the compiler cannot know that the stores below leave the arguments alone.
  const Vector3 p = shadingPoint;
  const Normal3 ng = side.ng, ns = side.ns;
  // A one-sided surface ignores light from below. Every cosine is above -2.
  const Real horizon = side.isTwoSided ? -2 : 0;
  const std::size_t count = cell.size();
  int lit = 0;
  EXPHOTON_INDEPENDENT_ITERATIONS
  for (std::size_t i = 0; i < count; ++i) {
    const Real dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z + kTiny;
    const Real inverse = 1 / std::sqrt(dx * dx + dy * dy + dz * dz);
    wx[i] = dx * inverse, wy[i] = dy * inverse, wz[i] = dz * inverse;
    const Real geometric = wx[i] * ng.x + wy[i] * ng.y + wz[i] * ng.z;
    const Real shading = wx[i] * ns.x + wy[i] * ns.y + wz[i] * ns.z;
    const int isLit = (geometric > horizon) & (shading > horizon);
    // Above kUnlit for a photon that does not light this side.
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

ReprojectedCell::ReprojectedCell(const GuideCell& cell, const Point3& p, const LitSide& side,
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
