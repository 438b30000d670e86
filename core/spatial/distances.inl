// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search_simd.cpp: distances to 16 boxes or points at a time, and masks of the
// lanes that hold data. Box distances use the same operations in the same order as point distances,
// and each operation is monotone. The rounded distance to a box is therefore never larger than to a
// point in it.

constexpr Real kLargest = std::numeric_limits<Real>::max();

struct Point16 {
  Real16 x, y, z;
  Point16() = default;
  explicit Point16(const Vec3& v) : x(Real16::All(v.x)), y(Real16::All(v.y)), z(Real16::All(v.z)) {}
};

// Returns the distances along one axis from `at` to the children's boxes.
HWY_INLINE Real16 BoxDistanceAlong(const BoxNode& node, int axis, const Real16& at) {
  return Max(Max(Real16::Load(node.low[axis]) - at, at - Real16::Load(node.high[axis])),
             Real16::All(0));
}

// Returns the squared distances from p to the children's boxes.
HWY_INLINE Real16 BoxDistance2(const BoxNode& node, const Point16& p) {
  const Real16 dx = BoxDistanceAlong(node, 0, p.x), dy = BoxDistanceAlong(node, 1, p.y),
               dz = BoxDistanceAlong(node, 2, p.z);
  return dx * dx + dy * dy + dz * dz;
}

// Returns the flattened squared distances (NearestQuery) from p to the children's boxes. n is the
// normal of the plane through p.
HWY_INLINE Real16 FlattenedBoxDistance2(const BoxNode& node, const Point16& p, const Point16& n,
                                        Real16 steepness) {
  const auto products = [&](int axis, Real16 at, Real16 normal, Real16* least, Real16* most) {
    const Real16 a = (Real16::Load(node.low[axis]) - at) * normal;
    const Real16 b = (Real16::Load(node.high[axis]) - at) * normal;
    *least = Min(a, b);
    *most = Max(a, b);
  };
  Real16 least[3], most[3];
  products(0, p.x, n.x, &least[0], &most[0]);
  products(1, p.y, n.y, &least[1], &most[1]);
  products(2, p.z, n.z, &least[2], &most[2]);
  const Real16 zero = Real16::All(0);
  const Real16 lowest = (least[0] + least[1] + least[2]) * steepness;
  const Real16 highest = (most[0] + most[1] + most[2]) * steepness;
  const Real16 height = Max(Max(lowest, zero - highest), zero);
  return Max(height * height, BoxDistance2(node, p));
}

// Returns the dot product of n and each point's direction. The directions are not normalised;
// *length2 receives their squared lengths.
HWY_INLINE Real16 DotDirection(const PointBlock& block, const Point16& n, Real16* length2) {
  const Real16 a = LoadHalves<false>(block.direction), b = LoadHalves<true>(block.direction);
  const Real16 z = Real16::All(kOctahedralOne) - Abs(a) - Abs(b);
  const Real16 fold = Max(Real16::All(0) - z, Real16::All(0));
  const Real16 x = a - CopySign(fold, a), y = b - CopySign(fold, b);
  *length2 = x * x + y * y + z * z;
  return x * n.x + y * n.y + z * n.z;
}

HWY_INLINE Real16 PointDistance2(const PointBlock& block, const Point16& p, Real16* dx, Real16* dy,
                                 Real16* dz) {
  *dx = Real16::Load(block.x) - p.x;
  *dy = Real16::Load(block.y) - p.y;
  *dz = Real16::Load(block.z) - p.z;
  return *dx * *dx + *dy * *dy + *dz * *dz;
}

// Returns the mask of the children that exist among a node's 16. At level -1, the children are the
// points of a block. The other lanes repeat the last child (PointBvh, BlockStore), so that all
// lanes hold finite numbers. A search must not choose them: where operations round at random
// (EXPHOTON_STOCHASTIC), equal lanes have different distances.
inline unsigned Present(const PointTreeView& view, int level, std::uint32_t node) {
  const std::uint32_t last = (view.count - 1) >> (4 * (level + 1));
  return node < last >> 4 ? 0xffff : (2u << (last & 15)) - 1;
}

inline const PointBlock& BlockAt(const PointTreeView& view, std::uint32_t block) {
  return *reinterpret_cast<const PointBlock*>(view.blocks + std::size_t(block) * view.blockBytes);
}

inline void PrefetchBlock(const PointBlock& block, std::size_t bytes) {
  const auto* line = reinterpret_cast<const char*>(&block);
  for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(line + at);
}

// Descends to the nearest box at each level. The block found is near p but not always the nearest,
// and its users need no more. Ties go to the lowest lane.
inline std::uint32_t BlockNear(const PointTreeView& view, const Point16& p) {
  std::uint32_t node = 0;
  for (int level = view.tree->Levels() - 1; level >= 0; --level)
    node = node * kBoxChildren + NearestLane(BoxDistance2(view.tree->Level(level)[node], p),
                                             Present(view, level, node));
  return node;
}

inline std::uint32_t FindBlockNear(const PointTreeView& view, const Point3& p) {
  return BlockNear(view, Point16(p));
}
