// SPDX-License-Identifier: BSD-2-Clause
// ReprojectedCell: a cell's photons as a point of a surface sees them: their directions, and which
// of them light its side. With the widest vectors that the machine has, to the same bits.
#pragma once

#include <span>

#include "core/base/arena.h"
#include "core/transport/shading_point.h"
#include "integrators/photon/gather/guide_cache.h"

namespace exphoton {

// The side of a surface that photons light.
struct LitSide {
  Normal3 ng, ns;           // unit, towards the viewer
  bool isTwoSided = false;  // the surface transmits: it is lit from below, too

  LitSide() = default;
  LitSide(const Normal3& geometric, const Normal3& shading, bool twoSided)
      : ng(geometric), ns(shading), isTwoSided(twoSided) {}
  explicit LitSide(const ShadingPoint& point)
      : ng(FaceForward(point.surface.ng, point.Wo())),
        ns(FaceForward(point.bsdf.Ns(), ng)),
        isTwoSided(point.bsdf.Has(LobeSet::NonSpecularTransmission)) {}
};

struct ReprojectedCell {
  // One of each for every photon of the cell, in its order, and 0 up to whole runs; in the arena.
  Real *x, *y, *z;  // unit directions
  Real* cosine;     // |w . ns|; more than kUnlit where it does not light the side
  int lit = 0;      // that do

  static constexpr Real kUnlit = Real(1e30);

  ReprojectedCell(const GuideCacheCell& cell, const Point3& p, const LitSide& side, Arena* arena);

  // From p - cell.Middle(). One for each width of vectors, for tests.
  using Looker = void (*)(const GuideCacheCell& cell, const Vector3& p, const LitSide& side,
                          ReprojectedCell* view);
  static std::span<const Looker> Lookers();  // that this machine can run, the widest last
};

}  // namespace exphoton
