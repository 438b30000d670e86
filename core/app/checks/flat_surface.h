// SPDX-License-Identifier: BSD-2-Clause
// A flat surface, and directions in which a BSDF on it is checked.
#pragma once

#include <cmath>
#include <vector>

#include "core/geometry/interaction.h"

namespace exphoton {

// Returns the plane z = 0 at the origin: normal +z, dpdu = x, uv = (.25, .75), no differentials.
inline SurfaceInteraction FlatSurface() {
  SurfaceInteraction si;
  si.ng = {0, 0, 1};
  si.uv = {Real(.25), Real(.75)};
  si.dpdu = {1, 0, 0};
  si.dpdv = {0, 1, 0};
  si.shading.n = si.ng;
  si.shading.dpdu = si.dpdu;
  si.shading.dpdv = si.dpdv;
  return si;
}

// Returns unit vectors with these cosines to z, at an azimuth off the axes.
inline std::vector<Vector3> Directions(const std::vector<Real>& cosines) {
  std::vector<Vector3> directions;
  for (Real cosine : cosines) {
    const Real sine = SafeSqrt((1 - cosine) * (1 + cosine));
    directions.push_back({sine * std::cos(Real(.7)), sine * std::sin(Real(.7)), cosine});
  }
  return directions;
}

// Moves a direction off the horizon if rounding may count it to the wrong cell.
inline Vector3 OffHorizon(const Vector3& w) {
  if (std::abs(w.z) > Real(1e-3)) return w;
  return Normalize(Vector3(w.x, w.y, std::copysign(Real(1e-3), w.z)));
}

}  // namespace exphoton
