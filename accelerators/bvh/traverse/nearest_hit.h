// SPDX-License-Identifier: BSD-2-Clause
// NearestHit: what a walk through triangles has found so far. Hits are ordered as DecideTriangle
// orders them, but to ask it takes doubles, and more time than all else in a leaf: of two triangles
// whose distances in single precision (triangle_single.h) are clearly apart it is not asked.
#pragma once

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

struct NearestHit {
  explicit NearestHit(Real tMax) : low(tMax), high(tMax) { hit.t = tMax; }

  Hit hit;  // as it will be told; its t is that of the ray's end where there is none
  // Between which lies the distance by which it is ordered; equal where that is known.
  Real low, high;
  const BvhBlock* block = nullptr;  // of a triangle whose distance is not known
  int lane = 0;
};

// Tests a shape or an instance against a nearest hit whose distance is known. Theirs is ordered as
// it is told.
inline void IntersectOther(const PrimitiveSet& primitives, std::uint32_t id, const TraceRay& ray,
                           NearestHit* nearest) {
  Hit ordered = nearest->hit;
  ordered.t = nearest->high;
  const Hit before = ordered;
  primitives.Intersect(id, ray, &ordered);
  if (ordered.primitive == before.primitive && ordered.instance == before.instance &&
      ordered.t == before.t)
    return;
  nearest->hit = ordered;
  nearest->low = nearest->high = ordered.t;
}

}  // namespace exphoton
