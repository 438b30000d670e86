// SPDX-License-Identifier: BSD-2-Clause
// The arrays of a bounding volume hierarchy with eight children a node and eight triangles a leaf,
// as vectors of eight read them: one row of eight for each coordinate. Nodes and leaves lie in one
// array of cache lines, in the order of a walk.
// Source: Wald, Benthin and Boulos 2008, "Getting rid of packets"; Dammertz, Hanika and Keller
// 2008, "Shallow bounding volume hierarchies for fast SIMD ray tracing of incoherent rays";
// Fuetterling, Lojewski, Pfreundt, Hamann and Ebert 2017, "Accelerated single ray tracing for wide
// vector units" (the order of children by the signs of the ray's direction).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/large_pages.h"
#include "core/scene/primitive.h"

namespace exphoton {

inline constexpr int kBvhWidth = 8;
inline constexpr std::size_t kBvhLine = 64;  // bytes of a line of the cache

struct alignas(kBvhLine) BvhLine {
  std::byte bytes[kBvhLine];
};
struct BvhNode;
struct BvhBlock;

// What a child is, and where: inner node or block of triangles (the number of their first line), or
// list of other primitives.
class BvhChild {
 public:
  enum class Kind : std::uint32_t { Node = 0, Triangles = 1, Others = 2 };
  static constexpr std::uint32_t kMaxIndex = (std::uint32_t(1) << 29) - 1;

  BvhChild() = default;  // no value: stacks of them cost nothing
  BvhChild(Kind kind, std::uint32_t index) : bits_(index << kShift | std::uint32_t(kind)) {}
  bool IsNode() const { return (bits_ & kMask) == std::uint32_t(Kind::Node); }
  bool IsTriangles() const { return (bits_ & kMask) == std::uint32_t(Kind::Triangles); }
  Kind GetKind() const { return Kind(bits_ & kMask); }
  std::uint32_t Index() const { return bits_ >> kShift; }

  // What it stands for, among the lines of its hierarchy.
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
  // Three bits, so that the address of a node is the bits times 8: no work for a processor.
  static constexpr std::uint32_t kShift = 3, kMask = (1 << kShift) - 1;
  static const char* At(const BvhLine* lines, std::uint32_t bits) {
    return reinterpret_cast<const char*>(lines) + std::size_t(bits) * (kBvhLine >> kShift);
  }

  std::uint32_t bits_;
};

// What stands for a missing child: a list of no primitives. Where rays are so long or so far away
// that their arithmetic overflows, a missing child may be taken for met; then nothing is found.
inline const BvhChild kMissingChild{BvhChild::Kind::Others, 0};

// An order of the eight lanes: four bits each, the first lowest.
using BvhOrder = std::uint32_t;
inline constexpr std::size_t kBvhBlockingOrder = 4;

// Bounds of the children: rows min x, max x, min y, max y, min z, max z. A missing child has empty
// bounds, which hardly any ray meets.
struct alignas(kBvhLine) BvhNode {
  Real rows[6][kBvhWidth];
  BvhChild children[kBvhWidth];
  // [0..3]: from near to far for directions with positive z, by whether x (1) and y (2) are
  // negative; for the opposite direction it is the same backwards. [4]: those that are likely to
  // block a ray, for their cost, first.
  std::array<BvhOrder, 5> orders;
};

// Up to eight triangles: rows of vertex 0 x, y, z, vertex 1 x, ... Missing ones have the id kNoId.
struct alignas(kBvhLine) BvhBlock {
  Real vertices[3][3][kBvhWidth];
  std::uint32_t ids[kBvhWidth];
};

inline constexpr std::uint32_t kBvhNodeLines = sizeof(BvhNode) / kBvhLine;
inline constexpr std::uint32_t kBvhBlockLines = sizeof(BvhBlock) / kBvhLine;

struct BvhArrays {
  LargeVector<BvhLine> lines;  // the root first; empty for an empty set
  // Leaves of shapes and instances: a count, then as many primitive ids. The first is
  // kMissingChild.
  std::vector<std::uint32_t> others;
  Bounds3 bounds;  // of everything, with margins
  int depth = 0;   // nodes on the longest way down
};

// Rounding in the intersection tests shifts what is hit, across the ray, by less than this part of
// the distance from the ray's origin to the farthest vertex. That is at most the distance to the
// hit (allowed for by the traversal) and the extent of the primitive (added to its bounds).
inline constexpr Real kBvhMargin = Gamma(16);

// No way down has more nodes, so that the traversal's stack has a fixed size.
inline constexpr int kBvhMaxDepth = 160;

}  // namespace exphoton
