// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search.inl: batched searches for the closest disk.

// Runs up to 16 queries together. Each query first scans its entry block. Then all queries descend
// the BVH level by level. One list holds pairs of a query and a box no farther than its best disk.
// Hardly any branch depends on a single query, so the processor can overlap several.
class BatchedClosestSearch {
 public:
  static constexpr std::size_t kMost = 16;

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
      // radius is tried first. An unlimited radius would overflow the list.
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
      if (count > kRoom) {  // list full: the single-query walk shrinks its radius as it goes
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

  static constexpr std::size_t kRoom = 256;
  static constexpr Real kGuess2 = Real(1) / 16;  // a factor of two changes little
  std::uint32_t first_[kMost];
  unsigned unbatchedQueries_;  // bit i: query i needs a single-query walk
  std::uint32_t lists_[2][kRoom + 2 * kBlockPoints];
  Real distance2_[kBlockPoints];  // scratch output of AppendLanes, never read
};

void Closest(const PointTreeView& view, const ClosestLimits& limits,
             std::span<const ClosestQuery> queries, ClosestPoint* found) {
  const Disks disks{view, limits};
  if (queries.size() == 1) {
    *found = ClosestToOne(disks, queries[0]);
    return;
  }
  BatchedClosestSearch together;
  for (; !queries.empty();
       queries = queries.subspan(std::min(BatchedClosestSearch::kMost, queries.size()))) {
    const auto some = queries.first(std::min(BatchedClosestSearch::kMost, queries.size()));
    together.Find(disks, some, found);
    found += some.size();
  }
}
