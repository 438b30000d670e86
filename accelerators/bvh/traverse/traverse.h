// SPDX-License-Identifier: BSD-2-Clause
// Walking rays through the hierarchy: one implementation (traverse.inl), compiled for each width of
// vectors; the widest that the machine has is chosen when the program runs. All give the same
// hits, bit for bit, which are those of brute force.
#pragma once

#include "accelerators/bvh/bvh_layout.h"
#include "accelerators/bvh/traverse/nearest_hit.h"

namespace exphoton {

// Room for a ray as the leaf test sees it, made ready once for all its leaves.
struct alignas(64) BlockRayRoom {
  std::byte bytes[512];
};

struct BvhTraversal {
  const char* name;
  Hit (*intersect)(const BvhArrays&, const PrimitiveSet&, const Ray&);
  bool (*occluded)(const BvhArrays&, const PrimitiveSet&, const Ray&);
  // The leaf test by itself, of `count` blocks, for other accelerators: makes a ray ready; replaces
  // the nearest where nearer (or as near with a lower id); decides its distance, which shapes and
  // instances need; whether any triangle blocks the ray.
  void (*makeBlockRay)(const TriangleRay&, BlockRayRoom*);
  void (*intersectBlocks)(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom&,
                          const TriangleRay&, NearestHit* nearest);
  void (*settle)(const TriangleRay&, NearestHit* nearest);
  bool (*occludedByBlocks)(const BvhBlock* blocks, std::uint32_t count, const BlockRayRoom&,
                           const TraceRay&);
};

extern const BvhTraversal kPortableTraversal;
#if defined(__x86_64__) && !defined(EXPHOTON_DOUBLE)
#define EXPHOTON_BVH_AVX 1
extern const BvhTraversal kAvx2Traversal;    // call only where the machine has AVX2
extern const BvhTraversal kAvx512Traversal;  // and only where it has AVX-512 F, VL and DQ
#endif

// The best one for this machine, with no wider vectors than wanted.
enum class BvhVectors { Portable, Avx2, Widest };
const BvhTraversal& FastestTraversal(BvhVectors widest);

}  // namespace exphoton
