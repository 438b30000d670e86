// SPDX-License-Identifier: BSD-2-Clause
// Construction of a kd-tree over a set of primitives by the surface area heuristic, on clipped
// bounds. Builds the arrays; knows nothing of rays.
// Source: MacDonald and Booth 1990; Wald and Havran 2006, "On building fast kd-Trees".
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/primitive.h"

namespace exphoton {

struct KdNode {  // 8 bytes; the child below the plane follows its parent
  static constexpr std::uint32_t kLeaf = 3;
  union {
    float split;           // inner: position of the plane
    std::uint32_t offset;  // leaf: of its first entry; with one entry, that entry itself
  };
  std::uint32_t bits;  // two low bits: axis or kLeaf; above them: child above the plane, or count

  static KdNode Leaf(std::uint32_t offset, std::uint32_t count) {
    KdNode node;
    node.offset = offset;
    node.bits = count << 2 | kLeaf;
    return node;
  }
  bool IsLeaf() const { return (bits & 3) == kLeaf; }
  int Axis() const { return int(bits & 3); }
  std::uint32_t High() const { return bits >> 2; }  // child above, or count
};
static_assert(sizeof(KdNode) == 8);

struct KdCosts {
  double intersect = 80, traverse = 1;
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
  std::vector<KdNode> nodes;           // [0] is the root; empty for an empty set
  std::vector<std::uint32_t> entries;  // primitive ids
  Bounds3 bounds;                      // with margins
};
KdArrays BuildKdTree(const PrimitiveSet& primitives, const KdCosts& costs);

}  // namespace exphoton
