// SPDX-License-Identifier: BSD-2-Clause
// BvhArrays stores a bounding volume hierarchy with eight children per node and eight triangles per
// leaf. Each coordinate of the eight is one row, which SIMD code loads as a vector. Nodes and
// leaves share one array of cache lines in depth-first order.
// Source: Wald, Benthin and Boulos 2008, "Getting rid of packets"; Dammertz, Hanika and Keller
// 2008, "Shallow bounding volume hierarchies for fast SIMD ray tracing of incoherent rays";
// Fuetterling, Lojewski, Pfreundt, Hamann and Ebert 2017, "Accelerated single ray tracing for wide
// vector units" (the order of children by the signs of the ray's direction).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "accelerators/bvh/huge_pages.h"
#include "core/scene/primitive.h"

namespace exphoton {

inline constexpr int kBvhWidth = 8;
inline constexpr std::size_t kBvhLine = 64;  // bytes of a cache line

struct alignas(kBvhLine) BvhLine {
  std::byte bytes[kBvhLine];
};
struct BvhNode;
struct BvhBlock;

// BvhChild refers to a child of a node. An inner node or a block of triangles is given by the index
// of its first cache line; a list of other primitives, by its index in BvhArrays::others.
class BvhChild {
 public:
  enum class Kind : std::uint32_t { Node = 0, Triangles = 1, Others = 2 };
  static constexpr std::uint32_t kMaxIndex = (std::uint32_t(1) << 29) - 1;

  BvhChild() = default;  // leaves stacks of children uninitialised
  BvhChild(Kind kind, std::uint32_t index) : bits_(index << kShift | std::uint32_t(kind)) {}
  bool IsNode() const { return (bits_ & kMask) == std::uint32_t(Kind::Node); }
  bool IsTriangles() const { return (bits_ & kMask) == std::uint32_t(Kind::Triangles); }
  Kind GetKind() const { return Kind(bits_ & kMask); }
  std::uint32_t Index() const { return bits_ >> kShift; }

  // Node and Block return the child in the hierarchy's array of cache lines.
  const BvhNode& Node(const BvhLine* lines) const {
    return *reinterpret_cast<const BvhNode*>(At(lines, bits_));
  }
  const BvhBlock& Block(const BvhLine* lines) const {
    return *reinterpret_cast<const BvhBlock*>(At(lines, bits_ - std::uint32_t(Kind::Triangles)));
  }
  void Prefetch(const BvhLine* lines) const {
    const char* const first = At(lines, bits_ & ~kMask);
    for (std::size_t i = 0; i < 5; ++i) __builtin_prefetch(first + i * kBvhLine);
  }

 private:
  // With three bits for the kind, the byte offset of a node is bits_ * 8. An addressing mode of the
  // processor computes this product at no cost.
  static constexpr std::uint32_t kShift = 3, kMask = (1 << kShift) - 1;
  static const char* At(const BvhLine* lines, std::uint32_t bits) {
    return reinterpret_cast<const char*>(lines) + std::size_t(bits) * (kBvhLine >> kShift);
  }

  std::uint32_t bits_;
};

// A missing child is an empty list of primitives. Rays that are so long or so far away that their
// arithmetic overflows may enter a missing child; they then find nothing.
inline const BvhChild kMissingChild{BvhChild::Kind::Others, 0};

// BvhOrder is a permutation of the eight lanes. Each takes four bits; the first is lowest.
using BvhOrder = std::uint32_t;
inline constexpr std::size_t kBvhBlockingOrder = 4;

// Rows hold the bounds of the children: min x, max x, min y, max y, min z, max z. A missing child
// has empty bounds, which hardly any ray enters.
struct alignas(kBvhLine) BvhNode {
  Real rows[6][kBvhWidth];
  BvhChild children[kBvhWidth];
  // Orders 0 to 3 are front to back for directions with positive z; bit 0 of the index is set for
  // negative x, bit 1 for negative y. The opposite direction reads the same order backwards.
  // Order 4 sorts the children by their probability of blocking a ray per unit of work, highest
  // first.
  std::array<BvhOrder, 5> orders;
};

// BvhBlock holds up to eight triangles. Its rows are x, y and z of vertex 0, of vertex 1 and of
// vertex 2. Missing triangles have the id kNoId.
struct alignas(kBvhLine) BvhBlock {
  Real vertices[3][3][kBvhWidth];
  std::uint32_t ids[kBvhWidth];
};

inline constexpr std::uint32_t kBvhNodeLines = sizeof(BvhNode) / kBvhLine;
inline constexpr std::uint32_t kBvhBlockLines = sizeof(BvhBlock) / kBvhLine;

struct BvhArrays {
  HugePageVector<BvhLine> lines;  // the root first; empty for an empty set
  // Lists of the shapes and instances in each leaf: a count, then that number of primitive ids. The
  // first list is empty and belongs to kMissingChild.
  std::vector<std::uint32_t> others;
  Bounds3 bounds;  // of all primitives, with margins
  int depth = 0;   // number of nodes on the longest path from the root
};

// Rounding in the intersection tests shifts a hit across the ray by less than this fraction of the
// distance from the ray's origin to the farthest vertex. That distance is at most the distance to
// the hit plus the extent of the primitive. Traversal allows for the first term; the primitive's
// bounds are padded for the second.
inline constexpr Real kBvhMargin = Gamma(16);

// Pads the bounds of a primitive on every side by at least the margin and at least one
// floating-point step. The result stays finite, because no hit is infinitely far away.
Bounds3 PaddedBounds(const Bounds3& bounds);

// No path from the root has more nodes, so the traversal stack has a fixed size.
inline constexpr int kBvhMaxDepth = 160;

}  // namespace exphoton
