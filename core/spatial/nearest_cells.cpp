// SPDX-License-Identifier: BSD-2-Clause
// NearestCells: construction, by top cell. A point stands for a disk of its surface that reaches to
// its neighbours; a cell is made where a disk passes, and split until its list serves all of it.
#include "core/spatial/nearest_cells.h"

#include <algorithm>

#include "core/spatial/nearest_set.h"

namespace exphoton {
namespace {

constexpr int kNeighbours = 9;           // the point itself and eight more
constexpr std::size_t kFewPoints = 256;  // a tree of so few is fast enough

// A cell of side s whose list reaches to d answers for its corners, s / sqrt(2) away on a flat
// surface, if no point is listed within d - s / sqrt(2) of them in a few of a hundred cases only.
constexpr Real kSideByReach = Real(.8);

// The k nearest points, in a buffer that is used again and again. Of points equally far any may be
// found, so that many on one spot need not all be looked at.
class Neighbours {
 public:
  explicit Neighbours(const PointKdTree& tree) : tree_(tree) {}
  std::span<const NearPoint> Find(const Point3& p, int k) {
    buffer_.resize(NearestSet<KeepAll>::BufferSize(k));
    NearestSet nearest(std::span<NearPoint>(buffer_), k, KeepAll());
    Real radius2 = kInfinity;
    tree_.SearchLeaves(p, &radius2, [&](const PointKdTree::Leaf& leaf, const Real* distance2) {
      const Real before2 = radius2;
      nearest.OfferLeaf(leaf, distance2, &radius2);
      if (radius2 < before2) radius2 = radius2 > 0 ? NextDown(radius2) : -1;
    });
    return nearest.Finish();
  }

 private:
  const PointKdTree& tree_;
  std::vector<NearPoint> buffer_;
};

// The piece of surface that a point stands for.
struct Disk {
  Point3 p;
  Normal3 n;
  Vector3 extent;  // half of its bounding box
  std::uint32_t id;

  bool Meets(const Point3& middle, Real half) const {
    const Vector3 offset = Abs(middle - p);
    if (offset.x > half + extent.x || offset.y > half + extent.y || offset.z > half + extent.z)
      return false;
    const Real reach = half * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
    return std::abs(Dot(n, middle - p)) <=
           reach * (1 + Gamma(32)) + Gamma(8) * MaxComponent(offset);
  }
};

Disk DiskOf(const PointKdTree& tree, std::uint32_t id, const Normal3& n, Real largest,
            Neighbours* neighbours) {
  const Point3 p = tree.Point(id);
  Real farthest2 = 0;
  for (const NearPoint& near : neighbours->Find(p, kNeighbours))
    farthest2 = std::max(farthest2, near.distance2);
  const Real radius = std::min(std::sqrt(farthest2), largest);
  const auto along = [&](Real c) { return radius * SafeSqrt(1 - c * c); };
  return {p, n, {along(n.x), along(n.y), along(n.z)}, id};
}

}  // namespace

// One top cell after the other, each into arrays of its own.
class NearestCellsBuilder {
 public:
  using Cell = NearestCells::Cell;
  using Node = NearestCells::Node;
  struct Part {
    std::uint32_t root = 0;
    std::vector<Node> nodes{Node{}};
    std::vector<Cell> cells;
  };

  explicit NearestCellsBuilder(const PointKdTree& tree) : neighbours_(tree) {}

  Part Build(const Point3& middle, Real half, std::vector<Disk> disks) {
    part_ = {};
    part_.root = Child(middle, half, NearestCells::kTopLevels, disks);
    return std::move(part_);
  }

 private:
  std::uint32_t Child(const Point3& middle, Real half, int level, const std::vector<Disk>& disks) {
    if (disks.empty()) return 0;
    if (disks.size() <= 2 * NearestCells::kListed) {
      if (const auto cell = MakeCell(middle, half)) {
        part_.cells.push_back(*cell);
        return NearestCells::kIsCell | std::uint32_t(part_.cells.size() - 1);
      }
    }
    if (level == NearestCells::kMaxLevels) return 0;
    Node node{};
    bool isEmpty = true;
    const Real quarter = half / 2;
    std::vector<Disk> inside;
    for (int i = 0; i < 8; ++i) {
      const Point3 m = middle + Vector3(i & 1 ? quarter : -quarter, i & 2 ? quarter : -quarter,
                                        i & 4 ? quarter : -quarter);
      inside.clear();
      for (const Disk& disk : disks)
        if (disk.Meets(m, quarter)) inside.push_back(disk);
      node[i] = Child(m, quarter, level + 1, inside);
      isEmpty = isEmpty && node[i] == 0;
    }
    if (isEmpty) return 0;
    part_.nodes.push_back(node);
    return std::uint32_t(part_.nodes.size() - 1);
  }

  // Nothing where the list would not reach far enough.
  std::optional<Cell> MakeCell(const Point3& middle, Real half) {
    const auto near = neighbours_.Find(middle, NearestCells::kListed);
    Cell cell;
    cell.middle = middle;
    cell.clear = std::sqrt(near.back().distance2);
    if (2 * half > kSideByReach * cell.clear) return std::nullopt;
    for (int i = 0; i < NearestCells::kListed; ++i) cell.ids[i] = near[i].index;
    std::sort(std::begin(cell.ids), std::end(cell.ids));
    return cell;
  }

  Neighbours neighbours_;
  Part part_;
};

NearestCells::NearestCells(const PointKdTree& tree, std::span<const Normal3> normals,
                           ThreadPool& threads) {
  if (tree.Size() < kFewPoints) return;
  constexpr int kTop = 1 << kTopLevels;
  const Bounds3& bounds = tree.Bounds();
  const Real size = MaxComponent(bounds.Diagonal()) * (1 + Gamma(8));
  if (!(size > 0) || !std::isfinite(size)) return;
  // The surfaces run through the middle of top cells, not along their borders.
  const Real side = size / Real(kTop - 1), half = side / 2;
  origin_ = bounds.Center() - Vector3(side * kTop / 2);
  scale_ = Real(1 << (kMaxLevels - kTopLevels)) / side;
  if (!(scale_ > 0) || !std::isfinite(scale_)) return;

  places_.reserve(tree.Size());
  for (std::uint32_t i = 0; i < tree.Size(); ++i) {
    const Point3 p = tree.Point(i);
    places_.push_back({{p.x, p.y, p.z, 0}});
  }
  constexpr std::int64_t kChunk = 1024;
  std::vector<Disk> disks(tree.Size());
  const auto count = std::int64_t(tree.Size());
  threads.For((count + kChunk - 1) / kChunk, [&](std::int64_t chunk, int) {
    Neighbours neighbours(tree);
    for (std::int64_t i = chunk * kChunk; i < std::min((chunk + 1) * kChunk, count); ++i)
      disks[i] = DiskOf(tree, std::uint32_t(i), normals[i], side, &neighbours);
  });
  std::vector<std::vector<Disk>> inTop(std::size_t(kTop) * kTop * kTop);
  const auto topMiddle = [&](int x, int y, int z) {
    return origin_ + Vector3(Real(2 * x + 1), Real(2 * y + 1), Real(2 * z + 1)) * half;
  };
  for (const Disk& disk : disks) {
    int low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Real p = disk.p[axis] - origin_[axis];
      low[axis] = std::clamp(int((p - disk.extent[axis]) / side), 0, kTop - 1);
      high[axis] = std::clamp(int((p + disk.extent[axis]) / side), 0, kTop - 1);
    }
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x)
          if (disk.Meets(topMiddle(x, y, z), half))
            inTop[(z * kTop + y) * kTop + x].push_back(disk);
  }

  std::vector<NearestCellsBuilder::Part> parts(inTop.size());
  threads.For(std::int64_t(inTop.size()), [&](std::int64_t i, int) {
    if (inTop[i].empty()) return;
    NearestCellsBuilder builder(tree);
    parts[i] = builder.Build(topMiddle(int(i) % kTop, int(i) / kTop % kTop, int(i) / kTop / kTop),
                             half, std::move(inTop[i]));
  });
  // One after the other: nodes behind the nodes, cells behind the cells.
  nodes_.push_back({});
  for (const auto& part : parts) {
    const auto nodeBase = std::uint32_t(nodes_.size()) - 1, cellBase = std::uint32_t(cells_.size());
    const auto moved = [&](std::uint32_t at) {
      return at == 0 ? 0 : at + (at & kIsCell ? cellBase : nodeBase);
    };
    top_.push_back(moved(part.root));
    for (std::size_t i = 1; i < part.nodes.size(); ++i) {
      nodes_.push_back(part.nodes[i]);
      for (std::uint32_t& child : nodes_.back()) child = moved(child);
    }
    cells_.insert(cells_.end(), part.cells.begin(), part.cells.end());
  }
}

std::size_t NearestCells::MemoryBytes() const {
  return top_.capacity() * sizeof(std::uint32_t) + nodes_.capacity() * sizeof(Node) +
         cells_.capacity() * sizeof(Cell) + places_.capacity() * sizeof(Place);
}

}  // namespace exphoton
