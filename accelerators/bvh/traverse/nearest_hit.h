// SPDX-License-Identifier: BSD-2-Clause
// NearestHit holds the nearest hit found so far during traversal. HitInDouble defines the order
// of hits, but its double-precision arithmetic costs more than all other work in a leaf. It is
// skipped for two triangles whose single-precision distances (triangle_single.h) clearly differ.
#pragma once

#include "accelerators/bvh/bvh_layout.h"

namespace exphoton {

struct NearestHit {
  explicit NearestHit(Real tMax) : low(tMax), high(tMax) { hit.t = tMax; }

  Hit hit;  // the hit to report; without one, t is the end of the ray
  // Bounds of the distance that orders the hit; equal once this distance is known.
  Real low, high;
  const BvhBlock* block = nullptr;  // the triangle's block while the distance is unknown
  int lane = 0;
};

// Tests a shape or an instance against a nearest hit whose distance is known. The reported distance
// of shapes and instances also orders them.
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
