// SPDX-License-Identifier: BSD-2-Clause
// BvhTraversal traces rays through the BVH. Its one implementation (traverse_simd.cpp) is compiled
// for each SIMD target, and the widest target of the machine is chosen at run time. All targets
// return the hits of brute force, bit for bit.
#pragma once

#include "accelerators/bvh/bvh_layout.h"
#include "accelerators/bvh/traverse/nearest_hit.h"

namespace exphoton {

// BlockRayRoom is storage for a ray in the form of the leaf test, prepared once for all leaves.
struct alignas(64) BlockRayRoom {
  std::byte bytes[512];
};

struct BvhTraversal {
  const char* name;
  Hit (*intersect)(const BvhArrays&, const PrimitiveSet&, const Ray&);
  bool (*occluded)(const BvhArrays&, const PrimitiveSet&, const Ray&);
  // These functions are the leaf test for other accelerators. makeBlockRay prepares a ray.
  // intersectBlocks replaces *nearest by a nearer hit, or by one at equal t with a lower id.
  // findDistance computes the distance of *nearest, which must be known before shapes and instances
  // are tested. occludedByBlocks returns whether any triangle of `count` blocks blocks the ray.
  void (*makeBlockRay)(const TriangleRay&, BlockRayRoom*);
  void (*intersectBlocks)(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom&,
                          const TriangleRay&, NearestHit* nearest);
  void (*findDistance)(const TriangleRay&, NearestHit* nearest);
  bool (*occludedByBlocks)(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom&,
                           const TraceRay&);
};

// FastestTraversal returns the best traversal for this machine that is no wider than `widest`.
enum class BvhVectors { Portable, Avx2, Widest };
const BvhTraversal& FastestTraversal(BvhVectors widest);

}  // namespace exphoton
