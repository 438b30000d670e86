// SPDX-License-Identifier: BSD-2-Clause
// Construction of a kd-tree over a set of primitives by the surface area heuristic, on clipped
// bounds. Builds the arrays; knows nothing of rays.
// Source: MacDonald and Booth 1990; Wald and Havran 2006, "On building fast kd-Trees".
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "accelerators/bvh/traverse/block_test.h"
#include "core/base/parallel.h"
#include "core/scene/primitive.h"

namespace exphoton {

struct KdNode {  // 8 bytes; the child below the plane follows its parent
  static constexpr std::uint32_t kLeaf = 3;
  union {
    float split;           // inner: position of the plane
    std::uint32_t offset;  // leaf: of its first block
  };
  std::uint32_t bits;  // two low bits: axis or kLeaf; above them: child above the plane, or, of a
                       // leaf, blocks and whether others follow

  static KdNode Leaf(std::uint32_t firstBlock, std::uint32_t blocks, bool hasOthers) {
    KdNode node;
    node.offset = firstBlock;
    node.bits = blocks << 3 | std::uint32_t(hasOthers) << 2 | kLeaf;
    return node;
  }
  static KdNode Inner(int axis, float split, std::uint32_t above) {
    KdNode node;
    node.split = split;
    node.bits = above << 2 | std::uint32_t(axis);
    return node;
  }
  // The same node where nodes and blocks lie so much farther on.
  KdNode Moved(std::uint32_t nodes, std::uint32_t blocks) const {
    KdNode node = *this;
    if (IsLeaf()) {
      node.offset += blocks;
    } else {
      node.bits += nodes << 2;
    }
    return node;
  }
  bool IsLeaf() const { return (bits & 3) == kLeaf; }
  bool IsEmpty() const { return bits == kLeaf; }  // a leaf of nothing
  int Axis() const { return int(bits & 3); }
  std::uint32_t Above() const { return bits >> 2; }   // inner: child above the plane
  std::uint32_t Blocks() const { return bits >> 3; }  // leaf: how many
  bool HasOthers() const { return bits & 4; }         // leaf: shapes or instances in it
};
static_assert(sizeof(KdNode) == 8);

// What a cell of so many primitives costs to test, in tests of a block: leaves are tested by
// eights.
inline double KdBlocks(std::size_t count) { return double((count + kBvhWidth - 1) / kBvhWidth); }

struct KdCosts {
  double intersect = 80, traverse = 1;  // of a block, of a step
  double emptyBonus = 0.5;
  std::uint32_t maxPrimitives = 1;
  int maxDepth = 0;
};
inline constexpr int kKdMaxDepth = 60;  // the traversal's stack holds as many

// Rounding in the intersection tests shifts what is hit, across the ray, by less than this part of
// the distance from the ray's origin to the farthest vertex. That is at most the distance to the
// hit (allowed for by the traversal) and the extent of the primitive (added to its bounds).
inline constexpr Real kKdMargin = Gamma(16);

struct KdArrays {
  RawLargeVector<KdNode> nodes;     // [0] is the root; empty for an empty set
  RawLargeVector<BvhBlock> blocks;  // the triangles of leaves, eight at a time
  // Of a leaf that has shapes or instances: a count and as many ids, at `others` of its node
  // number.
  std::vector<std::uint32_t> entries;
  std::unordered_map<std::uint32_t, std::uint32_t> others;
  Bounds3 bounds;  // with margins
};

// The tree depends on the set alone, not on the threads.
KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdCosts& costs, ThreadPool& threads);

// Below, threads would take longer to start than to save.
inline constexpr std::uint32_t kKdFewPrimitives = 10000;

}  // namespace exphoton
