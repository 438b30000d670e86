// SPDX-License-Identifier: BSD-2-Clause
// BuildKdTree constructs a kd-tree over a set of primitives by the surface area heuristic. This
// file does not depend on ray traversal.
// Source: MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision"; Pharr and
// Humphreys 2004, "Physically based rendering", section 4.4.
#pragma once

#include <cstdint>
#include <vector>

#include "accelerators/bvh/build/block.h"

namespace exphoton {

struct KdNode {  // 8 bytes; the child below the plane follows its parent
  static constexpr std::uint32_t kLeaf = 3;
  union {
    float split;          // inner: position of the plane
    std::uint32_t first;  // leaf: index of its first block, or of its list if it HasOthers
  };
  std::uint32_t bits;  // bits 0-1: axis or kLeaf. Inner: bits 2-31 index the child above the plane.
                       // Leaf: bit 2 is HasOthers, bits 3-31 count the blocks.

  static KdNode Leaf(std::uint32_t first, std::uint32_t blocks, bool hasOthers) {
    return {.first = first, .bits = blocks << 3 | std::uint32_t(hasOthers) << 2 | kLeaf};
  }
  static KdNode Inner(int axis, float split, std::uint32_t above) {
    return {.split = split, .bits = above << 2 | std::uint32_t(axis)};
  }
  bool IsLeaf() const { return (bits & 3) == kLeaf; }
  bool IsEmpty() const { return bits == kLeaf; }  // a leaf without primitives
  int Axis() const { return int(bits & 3); }
  std::uint32_t Above() const { return bits >> 2; }   // inner: index of the child above the plane
  std::uint32_t Blocks() const { return bits >> 3; }  // leaf: number of blocks
  bool HasOthers() const { return bits & 4; }         // leaf: contains shapes or instances
};
static_assert(sizeof(KdNode) == 8);

struct KdSettings {
  int intersectCost = 1, traversalCost = 3;  // per block, per traversal step
  Real emptyBonus = Real(.2);
  int maxPrimitives = 1, maxDepth = -1;
};
inline constexpr int kKdMaxDepth = 60;  // limits the traversal's stack

struct KdArrays {
  std::vector<KdNode> nodes;        // [0] is the root; empty for an empty set
  HugePageVector<BvhBlock> blocks;  // the triangles of leaves, eight at a time
  // Each leaf with shapes or instances has a list: the index of its first block, the number of
  // shapes and instances, and their ids.
  std::vector<std::uint32_t> lists;
  Bounds3 bounds;  // with margins
};

// maxDepth must be from 0 to kKdMaxDepth.
KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdSettings& settings);

}  // namespace exphoton
