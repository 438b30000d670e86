// SPDX-License-Identifier: BSD-2-Clause
// BuildKdTree constructs a kd-tree over a set of primitives by the surface area heuristic on
// clipped bounds. This file does not depend on ray traversal.
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
    std::uint32_t offset;  // leaf: index of the first block
  };
  std::uint32_t bits;  // bits 0-1: axis or kLeaf. Inner: bits 2-31 index the child above the plane.
                       // Leaf: bit 2 is HasOthers, bits 3-31 count the blocks.

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
  // Returns this node with its indices advanced by the given numbers of nodes and blocks.
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
  bool IsEmpty() const { return bits == kLeaf; }  // a leaf without primitives
  int Axis() const { return int(bits & 3); }
  std::uint32_t Above() const { return bits >> 2; }   // inner: index of the child above the plane
  std::uint32_t Blocks() const { return bits >> 3; }  // leaf: number of blocks
  bool HasOthers() const { return bits & 4; }         // leaf: contains shapes or instances
};
static_assert(sizeof(KdNode) == 8);

// Returns the cost of testing `count` primitives, in block tests: leaves test eight primitives at a
// time.
inline double KdBlocks(std::size_t count) { return double((count + kBvhWidth - 1) / kBvhWidth); }

struct KdCosts {
  double intersect = 80, traverse = 1;  // per block, per traversal step
  double emptyBonus = 0.5;
  std::uint32_t maxPrimitives = 1;
  int maxDepth = 0;
};
inline constexpr int kKdMaxDepth = 60;  // limits the traversal's stack

// Rounding in the intersection tests shifts a hit across the ray by less than this fraction of the
// distance from the ray's origin to the farthest vertex. That distance is at most the distance to
// the hit plus the extent of the primitive. Traversal allows for the first term; the primitive's
// bounds are padded for the second.
inline constexpr Real kKdMargin = Gamma(16);

struct KdArrays {
  UninitializedHugePageVector<KdNode> nodes;     // [0] is the root; empty for an empty set
  UninitializedHugePageVector<BvhBlock> blocks;  // the triangles of leaves, eight at a time
  // Each leaf with shapes or instances has a list in `entries`: a count, then that number of ids.
  // `others` maps the node's index to the position of its list.
  std::vector<std::uint32_t> entries;
  std::unordered_map<std::uint32_t, std::uint32_t> others;
  Bounds3 bounds;  // with margins
};

// The tree depends on the primitives alone, not on the number of threads.
KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdCosts& costs, ThreadPool& threads);

// For fewer primitives, starting threads takes longer than they save.
inline constexpr std::uint32_t kKdFewPrimitives = 10000;

}  // namespace exphoton
