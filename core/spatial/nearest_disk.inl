// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search.inl: the search for the closest disk.

// The closest disk, nearest boxes first; and first of all the block that the grid names, which is
// nearly always the right one. Then few others remain, and often none.
class ClosestWalk {
 public:
  // Looks at the first block; whether there may be something better in others. Hardly a branch, so
  // that a processor works at several queries at a time.
  [[gnu::always_inline]] bool Begin(const PointTreeView& view, const ClosestLimits& limits,
                                    const ClosestQuery& query, std::uint32_t first) {
    view_ = &view;
    p_ = Place16(query.p);
    n_ = Place16(query.n);
    minCosine_ = limits.minCosine;
    top_ = view.tree->Levels() - 1;
    best_ = {std::min(limits.maxRadius2, kLargest), ClosestPoint::kNone};
    const auto& block = static_cast<const DiskBlock&>(BlockAt(view, first));
    const Real16 distance2 = Distance2(block);
    const unsigned lanes = Serving(block, distance2);
    const Real nearest2 = LeastOf(distance2, lanes);
    const unsigned equal = lanes & EqualMask(distance2, Real16::All(nearest2));
    const std::uint32_t index =
        first * kBlockPoints + unsigned(__builtin_ctz(equal | 1u << kBlockPoints));
    best_.index = lanes != 0 ? index : best_.index;
    best_.distance2 = lanes != 0 ? nearest2 : best_.distance2;
    unsigned remaining = 0;
    for (int level = 0; level <= top_; ++level, first >>= 4) {
      Enter(level, first >> 4);
      pending_[level] = Promising(level, Present(view, level, first >> 4) & ~(1u << (first & 15)));
      remaining |= pending_[level];
    }
    return remaining != 0;
  }

  // Looks at the others.
  [[gnu::always_inline]] void Finish() {
    for (int level = 0;;) {
      if (pending_[level] == 0) {
        if (level++ == top_) return;
        pending_[level] = Promising(level, pending_[level]);
        continue;
      }
      const unsigned lane = NearestLane(boxes_[level], pending_[level]);
      pending_[level] &= ~(1u << lane);
      const std::uint32_t child = node_[level] * kBoxChildren + lane;
      if (level > 0) {
        --level;
        Enter(level, child);
        pending_[level] = Promising(level, Present(*view_, level, child));
      } else if (Scan(child)) {
        pending_[0] = Promising(0, pending_[0]);
      }
    }
  }

  ClosestPoint Best() const { return best_.index == ClosestPoint::kNone ? ClosestPoint() : best_; }

 private:
  void Enter(int level, std::uint32_t node) {
    node_[level] = node;
    boxes_[level] = BoxDistance2(view_->tree->Level(level)[node], p_);
  }

  // Of the lanes those that may hold something better: not farther, or nearer if indices there are
  // higher.
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

  unsigned Agreeing(const PointBlock& block) const {
    Real16 length2;
    const Real16 along = DotDirection(block, n_, &length2);
    const Real16 zero = Real16::All(0), least2 = Real16::All(minCosine_ * minCosine_) * length2;
    if (minCosine_ >= 0) return LessMask(zero, along) & LessMask(least2, along * along);
    return LessEqualMask(zero, along) | LessMask(along * along, least2);
  }

  Real16 Distance2(const PointBlock& block) const {
    Real16 dx, dy, dz;
    return PointDistance2(block, p_, &dx, &dy, &dz);
  }
  unsigned Serving(const DiskBlock& block, Real16 distance2) const {
    return LessEqualMask(distance2, Real16::All(best_.distance2)) &
           LessEqualMask(distance2, Real16::Load(block.reach2)) & Agreeing(block);
  }

  // Whether something better was found. Lanes that repeat the last point never are: of equals the
  // lowest is taken.
  bool Scan(std::uint32_t number) {
    const auto& block = static_cast<const DiskBlock&>(BlockAt(*view_, number));
    const Real16 distance2 = Distance2(block);
    if (LessEqualMask(distance2, Real16::All(best_.distance2)) == 0) return false;
    const unsigned lanes = Serving(block, distance2);
    if (lanes == 0) return false;
    const Real nearest2 = LeastOf(distance2, lanes);
    const std::uint32_t index =
        number * kBlockPoints +
        unsigned(__builtin_ctz(lanes & EqualMask(distance2, Real16::All(nearest2))));
    if (!(nearest2 < best_.distance2 || index < best_.index)) return false;
    best_ = {nearest2, index};
    return true;
  }

  const PointTreeView* view_;
  Place16 p_, n_;
  Real minCosine_;
  int top_;
  ClosestPoint best_;
  std::uint32_t node_[BoxTree::kMaxLevels];
  unsigned pending_[BoxTree::kMaxLevels];
  Real16 boxes_[BoxTree::kMaxLevels];
};

// The block to begin with; none where nothing can be found.
inline std::uint32_t FirstBlock(const PointTreeView& view, const Point3& p) {
  if (view.count == 0 || !IsFinite(p)) return ClosestPoint::kNone;
  return view.grid ? view.grid->BlockNear(p) : FindBlockNear(view, p);
}

ClosestPoint ClosestToOne(const PointTreeView& view, const ClosestLimits& limits,
                          const ClosestQuery& query) {
  const std::uint32_t first = FirstBlock(view, query.p);
  if (first == ClosestPoint::kNone) return {};
  ClosestWalk walk;
  if (walk.Begin(view, limits, query, first)) walk.Finish();
  return walk.Best();
}

void Closest(const PointTreeView& view, const ClosestLimits& limits,
             std::span<const ClosestQuery> queries, ClosestPoint* found) {
  constexpr std::size_t kAtOnce = 4;
  if (queries.size() == 1) *found = ClosestToOne(view, limits, queries[0]);
  if (queries.size() <= 1) return;
  ClosestWalk walks[kAtOnce];
  std::uint32_t first[kAtOnce];
  for (std::size_t begin = 0; begin < queries.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, queries.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      first[i] = FirstBlock(view, queries[begin + i].p);
      if (first[i] != ClosestPoint::kNone)
        PrefetchBlock(BlockAt(view, first[i]), sizeof(DiskBlock));
    }
    unsigned unfinished = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (first[i] != ClosestPoint::kNone)
        unfinished |= unsigned(walks[i].Begin(view, limits, queries[begin + i], first[i])) << i;
    for (std::size_t i = 0; i < count; ++i) {
      if (unfinished >> i & 1) walks[i].Finish();
      found[begin + i] = first[i] != ClosestPoint::kNone ? walks[i].Best() : ClosestPoint();
    }
  }
}
