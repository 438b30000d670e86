// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/bvh/bvh_subtree.h"

#include <new>

#include "accelerators/bvh/block_test.h"
#include "core/base/error.h"
#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxLeafOthers = 2;
constexpr Blocking kOtherBlocking{.5, 4};  // of shapes and instances: a guess
// What two leaves must save to be better than one: they take more memory, and to wait for memory is
// most of the work.
constexpr double kLeafPreference = 1.25;
constexpr int kSahDepth = 40;  // deeper nodes halve their runs: at most 32 levels more

}  // namespace

// Whether a run can be one leaf: few enough, and all of a kind.
bool BvhSubtree::CanBeLeaf(const BvhRun& run) const {
  const std::size_t count = run.items.size();
  if (count == 1) return true;
  if (count > std::max(std::size_t(maxLeafTriangles_), kMaxLeafOthers)) return false;
  const bool isTriangle = IsTriangle(run.items[0]);
  for (const BvhItem& item : run.items)
    if (IsTriangle(item) != isTriangle) return false;
  return count <= (isTriangle ? maxLeafTriangles_ : kMaxLeafOthers);
}

BvhSplit BvhSubtree::Split(const BvhRun& run, int depth) const {
  if (run.items.size() <= maxLeafTriangles_) {  // perhaps two kinds: part them
    const auto middle = std::partition(run.items.begin(), run.items.end(),
                                       [this](const BvhItem& item) { return IsTriangle(item); });
    const std::size_t triangles = std::size_t(middle - run.items.begin());
    if (triangles > 0 && triangles < run.items.size())
      return {triangles, 0, std::numeric_limits<double>::infinity()};
  }
  return depth > kSahDepth ? HalveRun(run) : SplitRun(run);
}

// Splits the largest part until there are eight.
BvhParts BvhSubtree::SplitIntoParts(const BvhRun& whole, int depth) const {
  BvhParts parts;
  parts.runs[0] = whole;
  parts.isLeaf[0] = whole.items.size() == 1;
  while (parts.count < kBvhWidth) {
    int widest = -1;
    double area = -1;
    for (int i = 0; i < parts.count; ++i) {
      if (const double a = HalfArea(parts.runs[i].box); a > area && !parts.isLeaf[i])
        area = a, widest = i;
    }
    if (widest < 0) break;
    const BvhRun run = parts.runs[widest];
    const BvhSplit split = Split(run, depth);
    if (CanBeLeaf(run) && LeafCost(run) <= kLeafPreference * split.cost) {
      parts.isLeaf[widest] = true;
      continue;
    }
    const int added = parts.count++;
    parts.runs[widest] = MakeRun(run.items.first(split.count));
    parts.runs[added] = MakeRun(run.items.subspan(split.count));
    for (const int i : {widest, added}) parts.isLeaf[i] = parts.runs[i].items.size() == 1;
    parts.orders.Split(widest, added, split.axis);
  }
  // Parts that there was no room to split further are nodes, unless they are small.
  for (int i = 0; i < parts.count; ++i) parts.isLeaf[i] |= CanBeLeaf(parts.runs[i]);
  return parts;
}

std::uint32_t BvhSubtree::NewLines(std::uint32_t count) {
  const std::size_t index = arrays_.lines.size();
  if (index + count > BvhChild::kMaxIndex)
    throw Error(ExitStatus::Resource, "the bounding volume hierarchy is too large");
  arrays_.lines.resize(index + count);
  return std::uint32_t(index);
}

void BvhSubtree::CheckDepth(int depth) {
  arrays_.depth = std::max(arrays_.depth, depth);
  if (depth > kBvhMaxDepth)
    throw Error(ExitStatus::Resource, "the bounding volume hierarchy is too deep");
}

BvhMade BvhSubtree::Tree(const BvhRun& whole, int depth) {
  const BvhParts parts = SplitIntoParts(whole, depth);
  return Node(whole, parts, depth, [&](int i) { return Tree(parts.runs[i], depth + 1); });
}

BvhMade BvhSubtree::Write(std::uint32_t line, const BvhRun& whole, const BvhParts& parts,
                          std::span<const BvhMade> made) {
  BvhNode node{};
  node.orders = parts.orders.Packed();
  std::array<ChildBlocking, kBvhWidth> blocking;
  const double area = HalfArea(whole.box);
  for (int i = 0; i < kBvhWidth; ++i) {
    Bounds3 bounds;
    node.children[i] = kMissingChild;
    if (i < parts.count) {
      node.children[i] = made[i].child;
      blocking[i] = {made[i].blocking, area > 0 ? HalfArea(parts.runs[i].box) / area : 1};
      bounds = parts.runs[i].box.ToBounds();
    }
    for (int axis = 0; axis < 3; ++axis) {
      node.rows[2 * axis][i] = bounds.min[axis];
      node.rows[2 * axis + 1][i] = bounds.max[axis];
    }
  }
  const Blocking own =
      OrderByBlocking(std::span(blocking).first(made.size()), &node.orders[kBvhBlockingOrder]);
  new (&arrays_.lines[line]) BvhNode(node);
  return {BvhChild(BvhChild::Kind::Node, line), own};
}

BvhMade BvhSubtree::Leaf(const BvhRun& run) {
  if (!IsTriangle(run.items[0])) {
    const auto index = std::uint32_t(arrays_.others.size());
    arrays_.others.push_back(std::uint32_t(run.items.size()));
    for (const BvhItem& item : run.items) arrays_.others.push_back(item.id);
    return {BvhChild(BvhChild::Kind::Others, index), kOtherBlocking};
  }
  // Lower ids first: of equal hits the first found stays.
  std::sort(run.items.begin(), run.items.end(),
            [](const BvhItem& a, const BvhItem& b) { return a.id < b.id; });
  std::array<std::uint32_t, kBvhWidth> ids;
  double area = 0;
  for (std::size_t i = 0; i < run.items.size(); ++i) {
    ids[i] = run.items[i].id;
    const auto& v = primitives_.TriangleVertices(ids[i]);
    const Vec3d first(v[0]);  // in double no area overflows
    area += Length(Cross(Vec3d(v[1]) - first, Vec3d(v[2]) - first)) / 2;
  }
  const BvhBlock block = MakeBlock(primitives_, std::span(ids).first(run.items.size()));
  const BvhChild self(BvhChild::Kind::Triangles, NewLines(kBvhBlockLines));
  new (&arrays_.lines[self.Index()]) BvhBlock(block);
  // A line that meets a convex body of surface 2 h meets a flat piece in it with 2 area / (2 h).
  const double halfArea = HalfArea(run.box);
  return {self, {halfArea > area ? area / halfArea : 1, 1}};
}

BvhBlock MakeBlock(const PrimitiveSet& primitives, std::span<const std::uint32_t> ids) {
  BvhBlock block{};
  for (std::size_t lane = 0; lane < kBvhWidth; ++lane) {
    block.ids[lane] = lane < ids.size() ? ids[lane] : kNoId;
    if (lane >= ids.size()) continue;
    const auto& vertices = primitives.TriangleVertices(ids[lane]);
    for (int v = 0; v < 3; ++v)
      for (int axis = 0; axis < 3; ++axis) block.vertices[v][axis][lane] = vertices[v][axis];
  }
  return block;
}

}  // namespace exphoton
