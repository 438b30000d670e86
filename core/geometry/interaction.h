// SPDX-License-Identifier: BSD-2-Clause
// SurfaceInteraction holds everything that shading needs from a hit, in world space. It is built
// once per ray, after traversal. It computes no light transport.
#pragma once

#include "core/geometry/ray.h"

namespace exphoton {

class Material;
class AreaLight;
class Motion;

struct SurfaceInteraction : SurfacePoint {  // p, pError, ng, time
  Vector3 wo;                               // unit, back along the ray
  Point2 uv;
  // Derivatives of the true surface. They are never 0 or parallel: a frame about ng replaces
  // degenerate derivatives.
  Vector3 dpdu, dpdv;
  Normal3 dndu, dndv;

  // The shading geometry has interpolated normals, changed by bump mapping. n has unit length and
  // lies on ng's side.
  struct Shading {
    Normal3 n;
    Vector3 dpdu, dpdv;
    Normal3 dndu, dndv;
  } shading;

  // The pixel footprint is the change per step of one pixel in x and y. All members are 0 if it is
  // unknown.
  bool hasDifferentials = false;
  Vector3 dpdx, dpdy;
  Real dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;

  const Material* material = nullptr;    // null: the surface does not scatter
  const AreaLight* areaLight = nullptr;  // null: the surface emits nothing
  const Motion* motion = nullptr;        // of the surface; null if it does not move
  // Numbers of the shape or instance and of its material, from 1 in the order of the file.
  std::uint32_t objectId = 0, materialId = 0;

  // Computes the footprint from the ray's differentials. Clears it if anything is not finite.
  void ComputeDifferentials(const RayDifferential& ray);
};

}  // namespace exphoton
