// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search.inl: searches for the closest disk, several at a time.

// Up to sixteen searches side by side: first the block that each begins with, then level by level
// the boxes as near as what it found there, all in one list. Hardly a branch depends on a single
// search, so that a processor works at several.
class ClosestTogether {
 public:
  static constexpr std::size_t kMost = 16;

  // best: one for each query.
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
      // In corners the first block is often of the other wall: as near as a part of it is wide
      // there mostly is one that serves. All that is left would be too much for the list.
      if (best[i].index == ClosestPoint::kNone)
        best[i].distance2 =
            std::min(best[i].distance2, kGuess2 * disks.Farthest2(first_[i], queries[i].p));
      lists_[0][open++] = std::uint32_t(i) << kNodeBits;  // at the root
    }
    alone_ = 0;
    std::uint32_t *from = lists_[0], *to = lists_[1];
    for (int level = disks.view.tree->Levels() - 1; level >= 0; --level, std::swap(from, to))
      open = Descend(disks, queries, best, level, {from, open}, to);
    for (const std::uint32_t item : std::span(from, open))
      disks.Scan(NodeOf(item), queries[QueryOf(item)], &best[QueryOf(item)]);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (best[i].index != ClosestPoint::kNone || first_[i] == ClosestPoint::kNone) continue;
      best[i] = disks.None();
      alone_ |= 1u << i;
    }
    for (; alone_ != 0; alone_ &= alone_ - 1) {
      const auto i = unsigned(__builtin_ctz(alone_));
      best[i] = ClosestWalk(disks, queries[i]).After(first_[i], best[i]);
    }
    for (std::size_t i = 0; i < queries.size(); ++i) best[i] = Disks::Answer(best[i]);
  }

 private:
  // An item of a list: a node or block, below the number of the query that is to look at it.
  static constexpr int kNodeBits = 28;
  static_assert(PointBvh::kMaxPoints / kBlockPoints <= std::size_t(1) << kNodeBits);
  static std::uint32_t QueryOf(std::uint32_t item) { return item >> kNodeBits; }
  static std::uint32_t NodeOf(std::uint32_t item) { return item & ((1u << kNodeBits) - 1); }

  // Of the nodes in the list the children that may hold something better; how many there are.
  std::size_t Descend(const Disks& disks, std::span<const ClosestQuery> queries,
                      const ClosestPoint* best, int level, std::span<const std::uint32_t> from,
                      std::uint32_t* to) {
    std::size_t count = 0;
    for (const std::uint32_t item : from) {
      const std::uint32_t q = QueryOf(item), node = NodeOf(item);
      if (count > kRoom) {  // so much is as near: one after the other, it becomes less
        alone_ |= 1u << q;
        continue;
      }
      const Real16 distance2 =
          BoxDistance2(disks.view.tree->Level(level)[node], Place16(queries[q].p));
      unsigned children = Present(disks.view, level, node) &
                          LessEqualMask(distance2, Real16::All(best[q].distance2));
      if (level == 0 && first_[q] >> 4 == node) children &= ~(1u << (first_[q] & 15));
      count += AppendLanes(distance2, q << kNodeBits | node * kBoxChildren, children, distance2_,
                           to + count);
    }
    return count;
  }

  static constexpr std::size_t kRoom = 256;
  static constexpr Real kGuess2 = Real(1) / 16;  // twice or half of it is as good
  std::uint32_t first_[kMost];
  unsigned alone_;  // those to be found by a walk
  std::uint32_t lists_[2][kRoom + 2 * kBlockPoints];
  Real distance2_[kBlockPoints];  // that nobody reads
};

void Closest(const PointTreeView& view, const ClosestLimits& limits,
             std::span<const ClosestQuery> queries, ClosestPoint* found) {
  const Disks disks{view, limits};
  if (queries.size() == 1) {
    *found = ClosestToOne(disks, queries[0]);
    return;
  }
  ClosestTogether together;
  for (; !queries.empty();
       queries = queries.subspan(std::min(ClosestTogether::kMost, queries.size()))) {
    const auto some = queries.first(std::min(ClosestTogether::kMost, queries.size()));
    together.Find(disks, some, found);
    found += some.size();
  }
}
