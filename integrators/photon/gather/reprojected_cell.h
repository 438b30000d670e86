// SPDX-License-Identifier: BSD-2-Clause
// ReprojectedCell is a cache cell reprojected to a shading point: the directions of its photons,
// and which of them light the side of the surface. It uses the machine's widest SIMD target; all
// give the same bits.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/guide_grid.h"

namespace exphoton {

// LitSide describes the side of a surface that photons light.
struct LitSide {
  Normal3 ng, ns;           // unit, towards the viewer
  bool isTwoSided = false;  // the surface transmits, so light from below counts too

  LitSide() = default;
  LitSide(const Normal3& geometric, const Normal3& shading, bool twoSided)
      : ng(geometric), ns(shading), isTwoSided(twoSided) {}
  explicit LitSide(const ShadingPoint& point)
      : ng(FaceForward(point.surface.ng, point.Wo())),
        ns(FaceForward(point.bsdf.Ns(), ng)),
        isTwoSided(point.bsdf.Has(LobeSet::NonSpecularTransmission)) {}
};

struct ReprojectedCell {
  // Arrays with one element per photon, in the cell's order, padded with 0 to whole runs. They lie
  // in the arena.
  Real *x, *y, *z;  // unit directions
  Real* cosine;     // |w . ns|; above kUnlit if the photon does not light the side
  int lit = 0;      // number of photons that light the side

  static constexpr Real kUnlit = Real(1e30);

  ReprojectedCell(const GuideCell& cell, const Point3& p, const LitSide& side, Arena* arena);

  // A Kernel computes the arrays as seen from p, which is relative to cell.Center(). There is one
  // per SIMD target, for tests.
  using Kernel = void (*)(const GuideCell& cell, const Vector3& p, const LitSide& side,
                          ReprojectedCell* view);
  static std::span<const Kernel> Kernels();  // for this machine, widest last
};

}  // namespace exphoton
