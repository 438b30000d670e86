// SPDX-License-Identifier: BSD-2-Clause
// SurfaceInteraction: all that shading needs to know of a hit, in world space. Built once per ray,
// after traversal. Holds no light transport of its own.
#pragma once

#include "core/geometry/ray.h"

namespace exphoton {

class Material;
class AreaLight;
class Motion;

struct SurfaceInteraction : SurfacePoint {  // p, pError, ng, time
  Vector3 wo;                               // unit, back along the ray
  Point2 uv;
  Vector3 dpdu, dpdv;  // of the true surface; never 0 nor parallel (a frame round ng replaces such)
  Normal3 dndu, dndv;

  // Shading geometry: interpolated normals, then bump mapping. n is unit and on ng's side.
  struct Shading {
    Normal3 n;
    Vector3 dpdu, dpdv;
    Normal3 dndu, dndv;
  } shading;

  // Footprint of a pixel: changes per step of one pixel in x and y. All 0 where unknown.
  bool hasDifferentials = false;
  Vector3 dpdx, dpdy;
  Real dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;

  const Material* material = nullptr;    // null: the surface is invisible to transport
  const AreaLight* areaLight = nullptr;  // null: emits nothing
  const Motion* motion = nullptr;        // of the surface; null: it rests

  // Fills the footprint from the ray's neighbours; clears it where anything is not finite.
  void ComputeDifferentials(const RayDifferential& ray);
};

}  // namespace exphoton
