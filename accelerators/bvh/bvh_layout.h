// SPDX-License-Identifier: BSD-2-Clause
// The arrays of a bounding volume hierarchy with eight children a node and eight triangles a block,
// as vectors of eight read them: one row of eight for each coordinate.
// Source: Wald, Benthin and Boulos 2008, "Getting rid of packets"; Dammertz, Hanika and Keller
// 2008, "Shallow bounding volume hierarchies for fast SIMD ray tracing of incoherent rays".
#pragma once

#include <cstdint>
#include <new>
#include <vector>

#include "core/scene/primitive.h"

namespace exphoton {

inline constexpr int kBvhWidth = 8;

// What a child is, and where: inner node, run of triangle blocks, or list of other primitives.
class BvhChild {
 public:
  enum class Kind : std::uint32_t { Node = 0, Triangles = 1, Others = 2 };
  static constexpr std::uint32_t kMaxIndex = (std::uint32_t(1) << 30) - 1;

  BvhChild() = default;  // no value: stacks of them cost nothing
  BvhChild(Kind kind, std::uint32_t index) : bits_(std::uint32_t(kind) << 30 | index) {}
  bool IsNode() const { return bits_ <= kMaxIndex; }
  bool IsTriangles() const { return (bits_ >> 30) == std::uint32_t(Kind::Triangles); }
  std::uint32_t Index() const { return bits_ & kMaxIndex; }

 private:
  std::uint32_t bits_;
};

// Bounds of the children: rows min x, max x, min y, max y, min z, max z. A missing child has empty
// bounds, which no ray meets.
struct alignas(32) BvhNode {
  Real rows[6][kBvhWidth];
  BvhChild children[kBvhWidth];
};

// Up to eight triangles: rows of vertex 0 x, y, z, vertex 1 x, ... Missing ones have the id kNoId.
struct alignas(32) BvhBlock {
  Real vertices[3][3][kBvhWidth];
  std::uint32_t ids[kBvhWidth];
  std::uint32_t validMask;  // a bit a lane
  std::uint32_t isLast;     // of the blocks of its leaf
};

struct BvhArrays {
  std::vector<BvhNode> nodes;  // [0] is the root; empty for an empty set
  std::vector<BvhBlock> blocks;
  // Leaves of shapes and instances: a count, then as many primitive ids.
  std::vector<std::uint32_t> others;
  Bounds3 bounds;  // of everything, with margins
  int depth = 0;   // nodes on the longest way down
};

// Rounding in the intersection tests shifts what is hit, across the ray, by less than this part of
// the distance from the ray's origin to the farthest vertex. That is at most the distance to the
// hit (allowed for by the traversal) and the extent of the primitive (added to its bounds).
inline constexpr Real kBvhMargin = Gamma(16);

// No way down is longer, so that the traversal's stack has a fixed size.
inline constexpr int kBvhMaxDepth = 80;

}  // namespace exphoton
