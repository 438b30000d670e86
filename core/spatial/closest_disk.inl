// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search_simd.cpp: of the disks that cover a point and face the same way, the
// search for the one with the closest centre, for one query (ClosestTraversal) and for batches of
// 16 (BatchedClosestSearch).

// The data that all queries of one call share.
struct Disks {
  const PointTreeView& view;
  const ClosestLimits& limits;

  // Returns the best result before any disk is found: no point, and the squared search radius as
  // its distance.
  ClosestPoint None() const { return {std::min(limits.maxRadius2, kLargest), ClosestPoint::kNone}; }

  // Returns the block where the search begins, or kNone if nothing can be found. The block from the
  // entry grid nearly always contains the closest disk.
  std::uint32_t FirstBlock(const Point3& p) const {
    if (view.count == 0 || !IsFinite(p)) return ClosestPoint::kNone;
    return view.grid ? view.grid->BlockNear(p) : FindBlockNear(view, p);
  }

  const DiskBlock& Block(std::uint32_t number) const {
    return static_cast<const DiskBlock&>(BlockAt(view, number));
  }

  unsigned NormalsAgreeMask(const PointBlock& block, const Point16& n) const {
    const Real minCosine = limits.minCosine;
    Real16 length2;
    const Real16 along = DotDirection(block, n, &length2);
    const Real16 zero = Real16::All(0), least2 = Real16::All(minCosine * minCosine) * length2;
    if (minCosine >= 0) return LessMask(zero, along) & LessMask(least2, along * along);
    return LessEqualMask(zero, along) | LessMask(along * along, least2);
  }

  // Returns the squared distance from p to the farthest point of the block.
  Real Farthest2(std::uint32_t number, const Point3& p) const {
    Real16 dx, dy, dz;
    return LargestOf(PointDistance2(Block(number), Point16(p), &dx, &dy, &dz));
  }

  // Replaces *best if the block has a closer disk, and returns whether it does. Ties go to the
  // lowest index.
  bool Scan(std::uint32_t number, const ClosestQuery& query, ClosestPoint* best) const {
    const DiskBlock& block = Block(number);
    Real16 dx, dy, dz;
    const Real16 distance2 = PointDistance2(block, Point16(query.p), &dx, &dy, &dz);
    unsigned lanes = LessEqualMask(distance2, Real16::All(best->distance2));
    if (lanes == 0) return false;
    lanes &= LessEqualMask(distance2, Real16::Load(block.radius2)) &
             NormalsAgreeMask(block, Point16(query.n)) & Present(view, -1, number);
    if (lanes == 0) return false;
    const Real nearest2 = LeastOf(distance2, lanes);
    const std::uint32_t index =
        number * kBlockPoints +
        unsigned(__builtin_ctz(lanes & EqualMask(distance2, Real16::All(nearest2))));
    if (!(nearest2 < best->distance2 || index < best->index)) return false;
    *best = {nearest2, index};
    return true;
  }

  static ClosestPoint Answer(const ClosestPoint& best) {
    return best.index == ClosestPoint::kNone ? ClosestPoint() : best;
  }
};

// Traverses the BVH for a single query and visits the nearest boxes first.
class ClosestTraversal {
 public:
  ClosestTraversal(const Disks& disks, const ClosestQuery& query)
      : disks_(disks), query_(query), p_(query.p), top_(disks.view.tree->Levels() - 1) {}

  // Returns the closest disk of all blocks. Block `first` must already be scanned; `best` is the
  // closest disk so far.
  ClosestPoint After(std::uint32_t first, const ClosestPoint& best) {
    best_ = best;
    for (int level = 0; level <= top_; ++level, first >>= 4) {
      Enter(level, first >> 4);
      pending_[level] &= ~(1u << (first & 15));
    }
    for (int level = 0;;) {
      if (pending_[level] == 0) {
        if (level++ == top_) return best_;
        pending_[level] = Promising(level, pending_[level]);
        continue;
      }
      const unsigned lane = NearestLane(boxes_[level], pending_[level]);
      pending_[level] &= ~(1u << lane);
      const std::uint32_t child = node_[level] * kBoxChildren + lane;
      if (level > 0) {
        Enter(--level, child);
      } else if (disks_.Scan(child, query_, &best_)) {
        pending_[0] = Promising(0, pending_[0]);
      }
    }
  }

 private:
  void Enter(int level, std::uint32_t node) {
    node_[level] = node;
    boxes_[level] = BoxDistance2(disks_.view.tree->Level(level)[node], p_);
    pending_[level] = Promising(level, Present(disks_.view, level, node));
  }

  // Returns the lanes whose boxes may hold a better disk. A box qualifies if it is nearer than the
  // best disk, or equally near with indices that may be lower: ties go to the lowest index.
  unsigned Promising(int level, unsigned lanes) const {
    const Real16 best2 = Real16::All(best_.distance2);
    lanes &= LessEqualMask(boxes_[level], best2);
    const unsigned equal = lanes & EqualMask(boxes_[level], best2);
    if (equal == 0) return lanes;
    const std::uint64_t first = std::uint64_t(node_[level]) * kBoxChildren;
    const std::uint64_t at = best_.index >> (4 * (level + 1));
    const std::uint64_t lower =
        at < first ? 0 : std::min<std::uint64_t>(at - first + 1, kBoxChildren);
    return lanes & ~(equal & ~((1u << lower) - 1));
  }

  const Disks& disks_;
  const ClosestQuery& query_;
  Point16 p_;
  int top_;
  ClosestPoint best_;
  std::uint32_t node_[PointBvh::kMaxLevels];
  unsigned pending_[PointBvh::kMaxLevels];
  Real16 boxes_[PointBvh::kMaxLevels];
};

inline ClosestPoint ClosestToOne(const Disks& disks, const ClosestQuery& query) {
  const std::uint32_t first = disks.FirstBlock(query.p);
  if (first == ClosestPoint::kNone) return {};
  ClosestPoint best = disks.None();
  disks.Scan(first, query, &best);
  return Disks::Answer(ClosestTraversal(disks, query).After(first, best));
}

// Runs up to 16 queries at a time. Each query first scans its entry block. Then all queries descend
// the BVH level by level. The list of a level holds pairs of a query and a box that is no farther
// than the query's best disk. Hardly any branch depends on a single query, so the processor can
// overlap several.
class BatchedClosestSearch {
 public:
  static constexpr std::size_t kMaxQueries = 16;

  // best has one result per query.
  void Find(const Disks& disks, std::span<const ClosestQuery> queries, ClosestPoint* best) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      first_[i] = disks.FirstBlock(queries[i].p);
      if (first_[i] != ClosestPoint::kNone)
        PrefetchBlock(disks.Block(first_[i]), sizeof(DiskBlock));
    }
    std::size_t open = 0;
    for (std::size_t i = 0; i < queries.size(); ++i) {
      best[i] = disks.None();
      if (first_[i] == ClosestPoint::kNone) continue;
      disks.Scan(first_[i], queries[i], &best[i]);
      // In a corner, the entry block often belongs to the other wall and has no valid disk. A valid
      // disk usually lies within a quarter of the distance to the block's farthest point, so this
      // radius is tried first. A larger radius would put too many boxes on the list.
      if (best[i].index == ClosestPoint::kNone)
        best[i].distance2 =
            std::min(best[i].distance2, kGuess2 * disks.Farthest2(first_[i], queries[i].p));
      lists_[0][open++] = std::uint32_t(i) << kNodeBits;  // at the root
    }
    unbatchedQueries_ = 0;
    std::uint32_t *from = lists_[0], *to = lists_[1];
    for (int level = disks.view.tree->Levels() - 1; level >= 0; --level, std::swap(from, to))
      open = Descend(disks, queries, best, level, {from, open}, to);
    for (const std::uint32_t item : std::span(from, open))
      disks.Scan(NodeOf(item), queries[QueryOf(item)], &best[QueryOf(item)]);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (best[i].index != ClosestPoint::kNone || first_[i] == ClosestPoint::kNone) continue;
      best[i] = disks.None();
      unbatchedQueries_ |= 1u << i;
    }
    for (; unbatchedQueries_ != 0; unbatchedQueries_ &= unbatchedQueries_ - 1) {
      const auto i = unsigned(__builtin_ctz(unbatchedQueries_));
      best[i] = ClosestTraversal(disks, queries[i]).After(first_[i], best[i]);
    }
    for (std::size_t i = 0; i < queries.size(); ++i) best[i] = Disks::Answer(best[i]);
  }

 private:
  // A list item: the query number in the upper bits, the node or block number in the lower bits.
  static constexpr int kNodeBits = 28;
  static_assert(PointBvh::kMaxPoints / kBlockPoints <= std::size_t(1) << kNodeBits);
  static std::uint32_t QueryOf(std::uint32_t item) { return item >> kNodeBits; }
  static std::uint32_t NodeOf(std::uint32_t item) { return item & ((1u << kNodeBits) - 1); }

  // Appends the children that may hold a better disk to `to`. Returns their number.
  std::size_t Descend(const Disks& disks, std::span<const ClosestQuery> queries,
                      const ClosestPoint* best, int level, std::span<const std::uint32_t> from,
                      std::uint32_t* to) {
    std::size_t count = 0;
    for (const std::uint32_t item : from) {
      const std::uint32_t q = QueryOf(item), node = NodeOf(item);
      // The list is full, so the query is left to the traversal for single queries. That needs no
      // list, because it finds near disks first.
      if (count > kListCapacity) {
        unbatchedQueries_ |= 1u << q;
        continue;
      }
      const Real16 distance2 =
          BoxDistance2(disks.view.tree->Level(level)[node], Point16(queries[q].p));
      unsigned children = Present(disks.view, level, node) &
                          LessEqualMask(distance2, Real16::All(best[q].distance2));
      if (level == 0 && first_[q] >> 4 == node) children &= ~(1u << (first_[q] & 15));
      count += AppendLanes(distance2, q << kNodeBits | node * kBoxChildren, children, distance2_,
                           to + count);
    }
    return count;
  }

  static constexpr std::size_t kListCapacity = 256;
  static constexpr Real kGuess2 = Real(1) / 16;  // twice or half of it is about as fast
  std::uint32_t first_[kMaxQueries];
  unsigned unbatchedQueries_;  // bit i: query i needs a ClosestTraversal
  std::uint32_t lists_[2][kListCapacity + 2 * kBlockPoints];
  Real distance2_[kBlockPoints];  // scratch output of AppendLanes, never read
};

void ClosestDisks(const PointTreeView& view, const ClosestLimits& limits,
                  std::span<const ClosestQuery> queries, ClosestPoint* found) {
  const Disks disks{view, limits};
  if (queries.size() == 1) {
    *found = ClosestToOne(disks, queries[0]);
    return;
  }
  BatchedClosestSearch search;
  for (; !queries.empty();
       queries = queries.subspan(std::min(BatchedClosestSearch::kMaxQueries, queries.size()))) {
    const auto batch = queries.first(std::min(BatchedClosestSearch::kMaxQueries, queries.size()));
    search.Find(disks, batch, found);
    found += batch.size();
  }
}
