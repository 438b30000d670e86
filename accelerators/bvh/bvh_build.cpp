// SPDX-License-Identifier: BSD-2-Clause
// Top-down: a node starts with one run of primitives as its child, and splits the child of the
// largest surface until there are eight.
#include "accelerators/bvh/bvh_build.h"

#include <array>

#include "accelerators/bvh/binned_split.h"
#include "core/base/error.h"

namespace exphoton {
namespace {

constexpr std::size_t kMaxLeafOthers = 2;
constexpr int kSahDepth = 40;  // deeper nodes halve their runs: at most 32 levels more

// Larger by at least the margin on every side, and by one step of Real where that is more. Finite:
// nothing is ever hit beyond.
Bounds3 Grown(const Bounds3& bounds) {
  constexpr Real kLargest = std::numeric_limits<Real>::max();
  const Real margin = kBvhMargin * MaxComponent(bounds.Diagonal());
  Bounds3 grown = bounds;
  for (int axis = 0; axis < 3; ++axis) {
    grown.min[axis] = std::max(NextDown(bounds.min[axis] - margin), -kLargest);
    grown.max[axis] = std::min(NextUp(bounds.max[axis] + margin), kLargest);
  }
  return grown;
}

class Builder {
 public:
  Builder(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles)
      : primitives_(primitives), maxLeafTriangles_(maxLeafTriangles) {}

  BvhArrays Build() && {
    std::vector<BvhItem> items;
    items.reserve(primitives_.Count());
    for (std::uint32_t id = 0; id < primitives_.Count(); ++id) {
      const Bounds3 bounds = primitives_.Bounds(id);
      if (!bounds.IsEmpty()) items.push_back({Grown(bounds), id});  // empty: instance of nothing
    }
    if (items.empty()) return {};
    arrays_.nodes.reserve(items.size() / 12 + 1);
    arrays_.blocks.reserve(items.size() / 5 + 1);
    const BvhRun root = MakeRun(items);
    arrays_.bounds = root.bounds;
    Node(root, 1);
    arrays_.nodes.shrink_to_fit();
    arrays_.blocks.shrink_to_fit();
    return std::move(arrays_);
  }

 private:
  bool IsTriangle(const BvhItem& item) const { return item.id < primitives_.TriangleCount(); }

  // Whether a run can be one leaf: few enough, and all of a kind.
  bool IsLeaf(const BvhRun& run) const {
    const std::size_t count = run.items.size();
    if (count == 1) return true;
    if (count > std::max(std::size_t(maxLeafTriangles_), kMaxLeafOthers)) return false;
    const bool isTriangle = IsTriangle(run.items[0]);
    for (const BvhItem& item : run.items)
      if (IsTriangle(item) != isTriangle) return false;
    return count <= (isTriangle ? maxLeafTriangles_ : kMaxLeafOthers);
  }

  std::size_t Split(const BvhRun& run, int depth) const {
    if (run.items.size() <= maxLeafTriangles_) {  // perhaps two kinds: part them
      const auto middle = std::partition(run.items.begin(), run.items.end(),
                                         [this](const BvhItem& item) { return IsTriangle(item); });
      const std::size_t triangles = std::size_t(middle - run.items.begin());
      if (triangles > 0 && triangles < run.items.size()) return triangles;
    }
    return depth > kSahDepth ? HalveRun(run) : SplitRun(run);
  }

  std::uint32_t Node(const BvhRun& whole, int depth) {
    arrays_.depth = std::max(arrays_.depth, depth);
    if (depth > kBvhMaxDepth || arrays_.nodes.size() >= BvhChild::kMaxIndex)
      throw Error(ExitStatus::Resource, "the bounding volume hierarchy is too large");
    const std::uint32_t index = std::uint32_t(arrays_.nodes.size());
    arrays_.nodes.emplace_back();

    std::array<BvhRun, kBvhWidth> runs{whole};
    int count = 1;
    while (count < kBvhWidth) {
      int widest = -1;
      double area = -1;
      for (int i = 0; i < count; ++i) {
        if (const double a = HalfArea(runs[i].bounds); a > area && !IsLeaf(runs[i]))
          area = a, widest = i;
      }
      if (widest < 0) break;
      const BvhRun run = runs[widest];
      const std::size_t first = Split(run, depth);
      runs[widest] = MakeRun(run.items.first(first));
      runs[count++] = MakeRun(run.items.subspan(first));
    }

    std::array<BvhChild, kBvhWidth> children{};
    for (int i = 0; i < count; ++i)
      children[i] = IsLeaf(runs[i]) ? Leaf(runs[i])
                                    : BvhChild(BvhChild::Kind::Node, Node(runs[i], depth + 1));
    BvhNode& node = arrays_.nodes[index];
    for (int i = 0; i < kBvhWidth; ++i) {
      const Bounds3 bounds = i < count ? runs[i].bounds : Bounds3();
      for (int axis = 0; axis < 3; ++axis) {
        node.rows[2 * axis][i] = bounds.min[axis];
        node.rows[2 * axis + 1][i] = bounds.max[axis];
      }
      node.children[i] = children[i];
    }
    return index;
  }

  BvhChild Leaf(const BvhRun& run) {
    if (!IsTriangle(run.items[0])) {
      const auto index = std::uint32_t(arrays_.others.size());
      arrays_.others.push_back(std::uint32_t(run.items.size()));
      for (const BvhItem& item : run.items) arrays_.others.push_back(item.id);
      return BvhChild(BvhChild::Kind::Others, index);
    }
    // Lower ids first: of equal hits the first found stays.
    std::sort(run.items.begin(), run.items.end(),
              [](const BvhItem& a, const BvhItem& b) { return a.id < b.id; });
    const auto index = std::uint32_t(arrays_.blocks.size());
    for (std::size_t i = 0; i < run.items.size(); i += kBvhWidth)
      Block(run.items.subspan(i, std::min(run.items.size() - i, std::size_t(kBvhWidth))));
    arrays_.blocks.back().isLast = 1;
    return BvhChild(BvhChild::Kind::Triangles, index);
  }

  void Block(std::span<const BvhItem> items) {
    BvhBlock& block = arrays_.blocks.emplace_back();
    block = {};
    block.validMask = (1u << items.size()) - 1;
    for (int lane = 0; lane < kBvhWidth; ++lane) {
      const bool isThere = std::size_t(lane) < items.size();
      block.ids[lane] = isThere ? items[lane].id : kNoId;
      if (!isThere) continue;
      const auto& vertices = primitives_.TriangleVertices(items[lane].id);
      for (int v = 0; v < 3; ++v)
        for (int axis = 0; axis < 3; ++axis) block.vertices[v][axis][lane] = vertices[v][axis];
    }
  }

  const PrimitiveSet& primitives_;
  const std::uint32_t maxLeafTriangles_;
  BvhArrays arrays_;
};

}  // namespace

BvhArrays BuildBvh(const PrimitiveSet& primitives, std::uint32_t maxLeafTriangles) {
  return Builder(primitives, maxLeafTriangles).Build();
}

}  // namespace exphoton
