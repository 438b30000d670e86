// SPDX-License-Identifier: BSD-2-Clause
// The searches, in terms of vectors of sixteen (Real16 and what goes with it), which the including
// file defines for its instructions. Box distances are rounded as point distances are, step by
// step, and every step is monotone: a box is never farther than a point in it.

constexpr Real kLargest = std::numeric_limits<Real>::max();

struct Place16 {
  Real16 x, y, z;
  Place16() = default;
  explicit Place16(const Vec3& v) : x(Real16::All(v.x)), y(Real16::All(v.y)), z(Real16::All(v.z)) {}
};

// Squared distances from p to the children's boxes; infinite for missing ones.
inline Real16 BoxDistance2(const BoxNode& node, const Place16& p) {
  const Real16 zero = Real16::All(0);
  const auto along = [&](int axis, Real16 at) {
    return Max(Max(Real16::Load(node.low[axis]) - at, at - Real16::Load(node.high[axis])), zero);
  };
  const Real16 dx = along(0, p.x), dy = along(1, p.y), dz = along(2, p.z);
  return dx * dx + dy * dy + dz * dz;
}

// The same as flattened distances: what a point's height over the plane through p with normal n
// makes of them.
inline Real16 FlattenedBoxDistance2(const BoxNode& node, const Place16& p, const Place16& n,
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
  // Of a missing child the height may be no number: then the second counts, which is infinite.
  return Max(height * height, BoxDistance2(node, p));
}

// The direction of each point, some length long, dotted with n.
inline Real16 DotDirection(const PointBlock& block, const Place16& n, Real16* length2) {
  Real16 a, b;
  LoadOctahedral(block.direction, &a, &b);
  const Real16 z = Real16::All(kOctahedralOne) - Abs(a) - Abs(b);
  const Real16 fold = Max(Real16::All(0) - z, Real16::All(0));
  const Real16 x = a - CopySign(fold, a), y = b - CopySign(fold, b);
  *length2 = x * x + y * y + z * z;
  return x * n.x + y * n.y + z * n.z;
}

inline const PointBlock& BlockAt(const PointTreeView& view, std::uint32_t block) {
  return *reinterpret_cast<const PointBlock*>(view.blocks + std::size_t(block) * view.blockBytes);
}

inline void PrefetchBlock(const PointBlock& block, std::size_t bytes) {
  const auto* line = reinterpret_cast<const char*>(&block);
  for (std::size_t at = 0; at < bytes; at += 64) __builtin_prefetch(line + at);
}

// The block nearest to p, going down to the nearest box at each level: in or beside p's
// surroundings, which is all that is asked of it.
inline std::uint32_t BlockNear(const PointTreeView& view, const Place16& p) {
  std::uint32_t node = 0;
  for (int level = view.tree->Levels() - 1; level >= 0; --level)
    node =
        node * kBoxChildren + NearestLane(BoxDistance2(view.tree->Level(level)[node], p), 0xffff);
  return node;
}

inline std::uint32_t FindBlockNear(const PointTreeView& view, const Point3& p) {
  return BlockNear(view, Place16(p));
}

// Candidates by ascending index, cut back to the k nearest when there is no more room.
class Candidates {
 public:
  Candidates(const NearBuffer& buffer, std::uint32_t k, Real limit2)
      : distance2_(buffer.distance2.data()),
        index_(buffer.index.data()),
        room_(NearBuffer::SizeFor(k) - 2 * kBlockPoints),
        k_(k),
        limit2_(limit2) {}

  Real Limit2() const { return limit2_; }
  std::size_t Count() const { return count_; }

  void Offer(Real16 distance2, unsigned mask, std::uint32_t firstIndex) {
    count_ += AppendLanes(distance2, firstIndex, mask, distance2_ + count_, index_ + count_);
    if (count_ > room_) Cut();
  }

  NearPoints Finish() {
    if (count_ > k_) Cut();
    if (count_ == 0) return {};
    PadToVector();
    const Real16 farthest = Real16::All(LargestWithin(kLargest));
    std::size_t last = (count_ - 1) / kBlockPoints * kBlockPoints;
    unsigned equal;
    while ((equal = EqualMask(Real16::LoadUnaligned(distance2_ + last), farthest)) == 0)
      last -= kBlockPoints;
    return {{distance2_, count_}, {index_, count_}, last + 31 - unsigned(__builtin_clz(equal))};
  }

 private:
  std::size_t CountWithin(Real pivot2) const {
    std::size_t within = 0;
    const Real16 pivot = Real16::All(pivot2);
    for (std::size_t i = 0; i < count_; i += kBlockPoints)
      within += CountLessEqual(Real16::LoadUnaligned(distance2_ + i), pivot);
    return within;
  }
  // Infinite distances, so that all can be read as whole vectors.
  void PadToVector() { Real16::All(kInfinity).StoreUnaligned(distance2_ + count_); }

  // The squared distance of the k-th nearest, of more than k. Squared distances are spread about
  // evenly on a surface, so pivots are interpolated; what they leave is sorted.
  Real KthDistance2() const {
    constexpr int kTries = 6;
    // The k-th is in (low2, high2]; what an earlier cut has left may be just beyond the limit.
    Real low2 = -1, high2 = NextUp(limit2_);
    std::size_t below = 0, upTo = count_;
    for (int i = 0; i < kTries && upTo > k_; ++i) {
      const Real from2 = low2 < 0 ? Real(0) : low2;
      const Real share = (Real(k_ - below) - Real(.5)) / Real(upTo - below);
      const Real pivot2 = from2 + (high2 - from2) * share;
      if (!(pivot2 > low2 && pivot2 < high2)) break;
      const std::size_t within = CountWithin(pivot2);
      if (within >= k_) {
        high2 = pivot2, upTo = within;
      } else {
        low2 = pivot2, below = within;
      }
    }
    if (upTo == k_) return LargestWithin(high2);
    return KthBetween(low2, high2, k_ - below);
  }

  Real LargestWithin(Real pivot2) const {
    const Real16 pivot = Real16::All(pivot2);
    Real16 largest = Real16::All(0);
    for (std::size_t i = 0; i < count_; i += kBlockPoints)
      largest = Max(largest, IfLessEqual(Real16::LoadUnaligned(distance2_ + i), pivot));
    Real lanes[kBlockPoints];
    largest.StoreUnaligned(lanes);
    return *std::max_element(lanes, lanes + kBlockPoints);
  }

  // The rank-th of those in (low2, high2].
  Real KthBetween(Real low2, Real high2, std::size_t rank) const {
    constexpr std::size_t kFew = 64;
    Real few[kFew] = {};
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_ && count < kFew; ++i) {
      few[count] = distance2_[i];
      count += distance2_[i] > low2 && distance2_[i] <= high2;
    }
    if (count < kFew) {
      std::nth_element(few, few + rank - 1, few + count);
      return few[rank - 1];
    }
    // Most are equal, or extremely uneven: halve by bits of the numbers, which are ordered as they.
    RealBits lowBits = low2 < 0 ? 0 : std::bit_cast<RealBits>(low2) + 1;
    RealBits highBits = std::bit_cast<RealBits>(high2);
    while (lowBits < highBits) {
      const RealBits middle = lowBits + (highBits - lowBits) / 2;
      if (CountWithin(std::bit_cast<Real>(middle)) >= k_) {
        highBits = middle;
      } else {
        lowBits = middle + 1;
      }
    }
    return std::bit_cast<Real>(lowBits);
  }

  // Keeps the k nearest. What comes later has a higher index, so it must be nearer than they are.
  void Cut() {
    PadToVector();
    const Real kth2 = KthDistance2();
    std::size_t spare = k_ - CountWithin(NextDownFrom(kth2));  // how many of the k are at kth2
    std::size_t kept = 0;
    const Real16 kth = Real16::All(kth2);
    for (std::size_t i = 0; i < count_; i += kBlockPoints) {
      const Real16 values = Real16::LoadUnaligned(distance2_ + i);
      unsigned mask = LessMask(values, kth);
      for (unsigned equal = EqualMask(values, kth); equal != 0 && spare > 0; equal &= equal - 1) {
        mask |= equal & -equal;
        --spare;
      }
      kept += KeepLanes(values, mask, index_ + i, distance2_ + kept, index_ + kept);
    }
    count_ = kept;
    limit2_ = NextDownFrom(kth2);
  }
  static Real NextDownFrom(Real x) {
    return x > 0 ? std::bit_cast<Real>(std::bit_cast<RealBits>(x) - 1) : Real(-1);
  }

  Real* distance2_;
  std::uint32_t* index_;
  std::size_t room_, count_ = 0;
  std::uint32_t k_;
  Real limit2_;
};

// Offers every point within the limit. measureBoxes(node) gives squared distances of the children,
// measure(block, &distance2) the lanes of a block that count.
template <class MeasureBoxes, class Measure>
inline void Collect(const PointTreeView& view, Candidates* candidates, MeasureBoxes&& measureBoxes,
                    Measure&& measure) {
  const int top = view.tree->Levels() - 1;
  std::uint32_t node[BoxTree::kMaxLevels];
  unsigned pending[BoxTree::kMaxLevels];
  int level = top;
  const auto enter = [&](std::uint32_t entered) {
    node[level] = entered;
    pending[level] = LessEqualMask(measureBoxes(view.tree->Level(level)[entered]),
                                   Real16::All(candidates->Limit2()));
    if (level > 0) return;
    for (unsigned rest = pending[0]; rest != 0; rest &= rest - 1)
      PrefetchBlock(BlockAt(view, entered * kBoxChildren + unsigned(__builtin_ctz(rest))),
                    sizeof(PointBlock));
  };
  enter(0);
  for (;;) {
    if (pending[level] == 0) {
      if (level++ == top) return;
      continue;
    }
    const std::uint32_t child =
        node[level] * kBoxChildren + unsigned(__builtin_ctz(pending[level]));
    pending[level] &= pending[level] - 1;
    if (level > 0) {
      --level;
      enter(child);
      continue;
    }
    const PointBlock& block = BlockAt(view, child);
    Real16 distance2;
    const unsigned lanes = measure(block, &distance2);
    candidates->Offer(distance2,
                      lanes & LessEqualMask(distance2, Real16::All(candidates->Limit2())),
                      child * kBlockPoints);
  }
}

inline Real16 PointDistance2(const PointBlock& block, const Place16& p, Real16* dx, Real16* dy,
                             Real16* dz) {
  *dx = Real16::Load(block.x) - p.x;
  *dy = Real16::Load(block.y) - p.y;
  *dz = Real16::Load(block.z) - p.z;
  return *dx * *dx + *dy * *dy + *dz * *dz;
}

// One search with a fixed radius.
inline void CollectFor(const PointTreeView& view, const NearestQuery& query, const Place16& p,
                       Candidates* candidates) {
  if (!query.isFlattened) {
    Collect(
        view, candidates, [&](const BoxNode& node) { return BoxDistance2(node, p); },
        [&](const PointBlock& block, Real16* distance2) {
          Real16 dx, dy, dz;
          *distance2 = PointDistance2(block, p, &dx, &dy, &dz);
          return 0xffffu;
        });
    return;
  }
  const Place16 n(query.n);
  const Real16 steepness = Real16::All(query.steepness);
  const unsigned always = query.isOneSided ? 0 : 0xffff;
  Collect(
      view, candidates,
      [&](const BoxNode& node) { return FlattenedBoxDistance2(node, p, n, steepness); },
      [&](const PointBlock& block, Real16* distance2) {
        Real16 dx, dy, dz, length2;
        *distance2 = PointDistance2(block, p, &dx, &dy, &dz);
        const Real16 height = (dx * n.x + dy * n.y + dz * n.z) * steepness;
        *distance2 = Max(height * height, *distance2);
        return always | LessMask(Real16::All(0), DotDirection(block, n, &length2));
      });
}

// Begins with the radius in which k points are to be expected and goes on with larger ones until
// they are there, so that far more are rarely looked at.
NearPoints Nearest(const PointTreeView& view, const NearestQuery& query, const NearBuffer& buffer) {
  if (view.count == 0 || !IsFinite(query.p)) return {};
  constexpr Real kFirst = Real(1.5), kGrowth = 4;
  const Place16 p(query.p);
  const Real max2 = std::min(query.maxRadius2, kLargest);
  Real radius2 = max2;
  if (view.spacing2) {
    const std::uint32_t run = BlockNear(view, p) / (PointTreeView::kSpacingPoints / kBlockPoints);
    radius2 = view.spacing2[run] * Real(query.k) * kFirst;
  }
  for (;; radius2 *= kGrowth) {
    if (!(radius2 > 0 && radius2 < max2)) radius2 = max2;
    Candidates candidates(buffer, query.k, radius2);
    CollectFor(view, query, p, &candidates);
    if (candidates.Count() >= query.k || radius2 == max2) return candidates.Finish();
  }
}

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
      pending_[level] = Promising(level, 0xffff & ~(1u << (first & 15)));
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
        pending_[level] = Promising(level, 0xffff);
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

  // Whether something better was found.
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
