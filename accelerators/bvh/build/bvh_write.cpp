// SPDX-License-Identifier: BSD-2-Clause
// WriteBvh assigns a position to every node and leaf first. Subtrees of at most kBvhPieceItems
// items are called trees here; the nodes above them are upper nodes. Both follow each other in
// depth-first order, with sizes counted in advance. Threads then write the trees. Upper nodes are
// written last, from the last to the first, because each needs the Blocking of its children: the
// estimated chance that a child blocks a shadow ray, and the cost of finding out (child_order.h).
#include "accelerators/bvh/build/bvh_write.h"

#include <algorithm>
#include <new>

#include "accelerators/bvh/build/block.h"
#include "accelerators/bvh/build/child_order.h"
#include "core/base/error.h"
#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

constexpr Blocking kOtherBlocking{.5, 4};  // a guess for shapes and instances

// Children lists the children of an 8-wide node by their index in the plan.
struct Children {
  std::array<std::uint32_t, kBvhWidth> nodes{};
  int count = 1;
  NearOrders orders;

  Children(std::span<const BvhPlanNode> plan, std::uint32_t node) {
    nodes[0] = node;
    Open(plan, 0, kBvhWidth, plan[node].shares.OfNode());
  }

 private:
  // Replaces a child by at most `most` nodes below it, `share` of them from its lower half. It
  // stays as it is if `share` is 0.
  void Open(std::span<const BvhPlanNode> plan, int child, int most, int share) {
    if (share == 0) return;
    const std::uint32_t node = nodes[child];
    const std::uint32_t lower = node + plan[node].lower, upper = node + plan[node].upper;
    const int added = count++;
    orders.Split(child, added, plan[node].axis);
    nodes[child] = lower, nodes[added] = upper;
    Open(plan, child, share, plan[lower].shares.Of(share));
    Open(plan, added, most - share, plan[upper].shares.Of(most - share));
  }
};

// Extent is a size in each of the two arrays, or a position in each.
struct Extent {
  std::size_t lines = 0, others = 0;

  Extent& operator+=(const Extent& e) {
    lines += e.lines, others += e.others;
    return *this;
  }
};

struct Written {
  BvhChild child;
  Blocking blocking;
};

class Writer {
 public:
  Writer(const PrimitiveSet& primitives, std::span<const BvhPlanNode> plan,
         std::span<BvhItem> items)
      : primitives_(primitives), plan_(plan), items_(items) {}

  BvhArrays Write(ThreadPool& threads) && {
    Gather(0, 1);
    threads.For(std::int64_t(trees_.size()), [&](std::int64_t i, int) {
      Part& part = parts_[trees_[std::size_t(i)]];
      part.depth = part.depth - 1 + Measure(part.node, &part.extent);
    });
    Place();
    threads.For(std::int64_t(trees_.size()), [&](std::int64_t i, int) {
      Part& part = parts_[trees_[std::size_t(i)]];
      Extent place = part.extent;
      part.written = WriteTree(part.node, &place);
    });
    for (std::size_t i = parts_.size(); i-- > 0;)
      if (!parts_[i].below.empty()) WriteUpper(&parts_[i]);
    arrays_.bounds = plan_[0].bounds;
    return std::move(arrays_);
  }

 private:
  // Part is an upper node with its leaves, or a whole tree.
  struct Part {
    std::uint32_t node = 0;          // index in the plan
    int depth = 1;                   // of the upper node, or of the deepest node of the tree
    Extent extent;                   // its size; after Place(), its position
    std::vector<std::size_t> below;  // upper nodes: the part of each child that is no leaf
    Written written;
  };

  bool IsTriangle(std::uint32_t id) const { return id < primitives_.TriangleCount(); }
  bool IsLeafOfTriangles(const BvhPlanNode& node) const {
    return IsTriangle(items_[node.first].id);
  }

  Extent LeafExtent(const BvhPlanNode& leaf) const {
    return IsLeafOfTriangles(leaf) ? Extent{kBvhBlockLines, 0} : Extent{0, 1 + leaf.count};
  }

  // Adds a part for each upper node and each tree in depth-first order. Returns the part's index.
  std::size_t Gather(std::uint32_t node, int depth) {
    const std::size_t own = parts_.size();
    parts_.push_back({node, depth, {}, {}, {}});
    if (plan_[node].count <= kBvhPieceItems) {
      trees_.push_back(own);
      return own;
    }
    const Children children(plan_, node);
    Extent extent{kBvhNodeLines, 0};
    std::vector<std::size_t> below(std::size_t(children.count));
    for (int i = 0; i < children.count; ++i) {
      const std::uint32_t child = children.nodes[i];
      if (plan_[child].isLeaf)
        extent += LeafExtent(plan_[child]);
      else
        below[std::size_t(i)] = Gather(child, depth + 1);
    }
    parts_[own].extent = extent, parts_[own].below = std::move(below);
    return own;
  }

  // Adds the size of a tree to *extent. Returns the number of nodes on its longest path.
  int Measure(std::uint32_t node, Extent* extent) const {
    const Children children(plan_, node);
    *extent += {kBvhNodeLines, 0};
    int deepest = 0;
    for (int i = 0; i < children.count; ++i) {
      const std::uint32_t child = children.nodes[i];
      if (plan_[child].isLeaf)
        *extent += LeafExtent(plan_[child]);
      else
        deepest = std::max(deepest, Measure(child, extent));
    }
    return deepest + 1;
  }

  void Place() {
    Extent end{0, 1};  // the list at position 0 is empty, for missing children
    for (Part& part : parts_) {
      const Extent extent = part.extent;
      part.extent = end;
      end += extent;
      arrays_.depth = std::max(arrays_.depth, part.depth);
    }
    if (end.lines > BvhChild::kMaxIndex || end.others > BvhChild::kMaxIndex)
      throw Error(ExitStatus::Resource, "the bounding volume hierarchy is too large");
    arrays_.lines.resize(end.lines);
    arrays_.others.resize(end.others);
  }

  // Writes a node and everything below it at *place and advances *place past them.
  Written WriteTree(std::uint32_t node, Extent* place) {
    const Children children(plan_, node);
    const std::size_t line = place->lines;
    place->lines += kBvhNodeLines;
    std::array<Written, kBvhWidth> written;
    WriteLeaves(children, place, &written);
    for (int i = 0; i < children.count; ++i)
      if (!plan_[children.nodes[i]].isLeaf) written[i] = WriteTree(children.nodes[i], place);
    return WriteNode(line, node, children, written);
  }

  void WriteUpper(Part* part) {
    const Children children(plan_, part->node);
    Extent place = part->extent;
    place.lines += kBvhNodeLines;
    std::array<Written, kBvhWidth> written;
    WriteLeaves(children, &place, &written);
    for (int i = 0; i < children.count; ++i)
      if (!plan_[children.nodes[i]].isLeaf)
        written[i] = parts_[part->below[std::size_t(i)]].written;
    part->written = WriteNode(part->extent.lines, part->node, children, written);
  }

  // Writes the leaves directly behind their node.
  void WriteLeaves(const Children& children, Extent* place,
                   std::array<Written, kBvhWidth>* written) {
    for (int i = 0; i < children.count; ++i) {
      const BvhPlanNode& child = plan_[children.nodes[i]];
      if (!child.isLeaf) continue;
      (*written)[i] = WriteLeaf(child, *place);
      *place += LeafExtent(child);
    }
  }

  Written WriteNode(std::size_t line, std::uint32_t whole, const Children& children,
                    std::span<const Written> written) {
    BvhNode node{};
    node.orders = children.orders.Packed();
    std::array<ChildBlocking, kBvhWidth> blocking;
    const double area = HalfArea(plan_[whole].bounds);
    for (int i = 0; i < kBvhWidth; ++i) {
      Bounds3 bounds;
      node.children[i] = kMissingChild;
      if (i < children.count) {
        bounds = plan_[children.nodes[i]].bounds;
        node.children[i] = written[i].child;
        blocking[i] = {written[i].blocking, area > 0 ? HalfArea(bounds) / area : 1};
      }
      for (int axis = 0; axis < 3; ++axis) {
        node.rows[2 * axis][i] = bounds.min[axis];
        node.rows[2 * axis + 1][i] = bounds.max[axis];
      }
    }
    const auto count = std::size_t(children.count);
    const Blocking own =
        OrderByBlocking(std::span(blocking).first(count), &node.orders[kBvhBlockingOrder]);
    new (&arrays_.lines[line]) BvhNode(node);
    return {BvhChild(BvhChild::Kind::Node, std::uint32_t(line)), own};
  }

  Written WriteLeaf(const BvhPlanNode& leaf, const Extent& place) {
    const std::span<BvhItem> items = items_.subspan(leaf.first, leaf.count);
    if (!IsLeafOfTriangles(leaf)) {
      std::uint32_t* list = &arrays_.others[place.others];
      *list++ = leaf.count;
      for (const BvhItem& item : items) *list++ = item.id;
      return {BvhChild(BvhChild::Kind::Others, std::uint32_t(place.others)), kOtherBlocking};
    }
    // Lower ids come first, because they win among hits at equal t (scene/hit_order.h).
    std::sort(items.begin(), items.end(),
              [](const BvhItem& a, const BvhItem& b) { return a.id < b.id; });
    std::array<std::uint32_t, kBvhWidth> ids;
    double area = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      ids[i] = items[i].id;
      const auto& v = primitives_.TriangleVertices(ids[i]);
      const Vec3d first(v[0]);  // in double precision no area overflows
      area += Length(Cross(Vec3d(v[1]) - first, Vec3d(v[2]) - first)) / 2;
    }
    new (&arrays_.lines[place.lines])
        BvhBlock(MakeBlock(primitives_, std::span(ids).first(items.size())));
    // A random line that meets a convex body of surface area S meets a flat piece of area A inside
    // it with probability 2 A / S. Here S is twice the half area.
    const double halfArea = HalfArea(leaf.bounds);
    return {BvhChild(BvhChild::Kind::Triangles, std::uint32_t(place.lines)),
            {halfArea > area ? area / halfArea : 1, 1}};
  }

  const PrimitiveSet& primitives_;
  const std::span<const BvhPlanNode> plan_;
  const std::span<BvhItem> items_;
  std::vector<Part> parts_;
  std::vector<std::size_t> trees_;  // indices of the parts that are whole trees
  BvhArrays arrays_;
};

}  // namespace

BvhArrays WriteBvh(const PrimitiveSet& primitives, std::span<const BvhPlanNode> plan,
                   std::span<BvhItem> items, ThreadPool& threads) {
  return Writer(primitives, plan, items).Write(threads);
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
