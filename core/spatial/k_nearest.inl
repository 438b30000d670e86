// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search_simd.cpp: the search for the k nearest points. Collect traverses the BVH
// with a fixed radius, and Candidates selects the k nearest of what it finds. KNearest repeats this
// with a larger radius while fewer than k points are found.

// Stores candidates by ascending index. A full buffer is cut back to the k nearest.
class Candidates {
 public:
  Candidates(const NearBuffer& buffer, std::uint32_t k, Real limit2)
      : distance2_(buffer.distance2.data()),
        index_(buffer.index.data()),
        capacity_(NearBuffer::SizeFor(k) - 2 * kBlockPoints),
        k_(k),
        limit2_(limit2) {}

  Real Limit2() const { return limit2_; }
  std::size_t Count() const { return count_; }

  void Offer(Real16 distance2, unsigned mask, std::uint32_t firstIndex) {
    count_ += AppendLanes(distance2, firstIndex, mask, distance2_ + count_, index_ + count_);
    if (count_ > capacity_) Cut();
  }

  // Returns the k nearest candidates. The last member is the position of the farthest of them.
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
  // Pads with infinite distances, so that the buffer can be read in vectors of 16 lanes.
  void PadToVector() { Real16::All(kInfinity).StoreUnaligned(distance2_ + count_); }

  // Returns the squared distance of the k-th nearest of more than k candidates. On a surface,
  // squared distances are about uniformly distributed, so pivots are interpolated linearly.
  // KthBetween then selects among the candidates left between the last two pivots.
  Real KthDistance2() const {
    constexpr int kMaxPivots = 6;
    // The k-th distance is in (low2, high2]. Candidates kept by an earlier cut may lie at the next
    // number above limit2_, so high2 includes them.
    Real low2 = -1, high2 = NextUp(limit2_);
    std::size_t below = 0, upTo = count_;
    for (int i = 0; i < kMaxPivots && upTo > k_; ++i) {
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
    return LargestOf(largest);
  }

  // Returns the rank-th smallest squared distance in (low2, high2].
  Real KthBetween(Real low2, Real high2, std::size_t rank) const {
    constexpr std::size_t kMaxSelected = 64;
    Real selected[kMaxSelected + kBlockPoints] = {};
    const Real16 low = Real16::All(low2), high = Real16::All(high2);
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_ && count < kMaxSelected; i += kBlockPoints) {
      const Real16 values = Real16::LoadUnaligned(distance2_ + i);
      count +=
          StoreLanes(values, LessMask(low, values) & LessEqualMask(values, high), selected + count);
    }
    if (count < kMaxSelected) {
      std::nth_element(selected, selected + rank - 1, selected + count);
      return selected[rank - 1];
    }
    // Most distances are equal or extremely uneven. Bisect the bit patterns, which have the same
    // order as the numbers because squared distances are not negative.
    RealBits lowBits = low2 < 0 ? 0 : std::bit_cast<RealBits>(low2) + 1;
    RealBits highBits = std::bit_cast<RealBits>(high2);
    while (lowBits < highBits) {
      const RealBits pivot = lowBits + (highBits - lowBits) / 2;
      if (CountWithin(std::bit_cast<Real>(pivot)) >= k_) {
        highBits = pivot;
      } else {
        lowBits = pivot + 1;
      }
    }
    return std::bit_cast<Real>(lowBits);
  }

  // Keeps the k nearest. Later candidates have higher indices and lose ties, so they must be
  // strictly nearer: limit2_ is the number just below the k-th distance.
  void Cut() {
    PadToVector();
    const Real kth2 = KthDistance2();
    // How many of the candidates at distance kth2 are still to be kept.
    std::size_t ties = k_ - CountWithin(NextDownFrom(kth2));
    std::size_t kept = 0;
    const Real16 kth = Real16::All(kth2);
    for (std::size_t i = 0; i < count_; i += kBlockPoints) {
      const Real16 values = Real16::LoadUnaligned(distance2_ + i);
      unsigned mask = LessMask(values, kth);
      for (unsigned equal = EqualMask(values, kth); equal != 0 && ties > 0; equal &= equal - 1) {
        mask |= equal & -equal;
        --ties;
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
  std::size_t capacity_, count_ = 0;
  std::uint32_t k_;
  Real limit2_;
};

// Offers every point within the limit to the candidates, in the order of their indices.
// measureBoxes(node) returns the squared distances of the children. measure(block, &distance2)
// returns the mask of the lanes that may be offered.
template <class MeasureBoxes, class Measure>
inline void Collect(const PointTreeView& view, Candidates* candidates, MeasureBoxes&& measureBoxes,
                    Measure&& measure) {
  const int top = view.tree->Levels() - 1;
  std::uint32_t node[PointBvh::kMaxLevels];
  unsigned pending[PointBvh::kMaxLevels];
  int level = top;
  const auto enter = [&](std::uint32_t entered) {
    node[level] = entered;
    pending[level] = Present(view, level, entered) &
                     LessEqualMask(measureBoxes(view.tree->Level(level)[entered]),
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
    const unsigned lanes = measure(block, &distance2) & Present(view, -1, child);
    candidates->Offer(distance2,
                      lanes & LessEqualMask(distance2, Real16::All(candidates->Limit2())),
                      child * kBlockPoints);
  }
}

// Runs one search with a fixed radius.
inline void CollectFor(const PointTreeView& view, const NearestQuery& query, const Point16& p,
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
  const Point16 n(query.n);
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

// The first radius is expected to contain somewhat more than k points. It grows until k points are
// found or the largest radius is reached, so the search rarely visits far more than k points.
NearPoints KNearest(const PointTreeView& view, const NearestQuery& query,
                    const NearBuffer& buffer) {
  if (view.count == 0 || !IsFinite(query.p)) return {};
  constexpr Real kFirst = Real(1.5), kGrowth = 4;
  const Point16 p(query.p);
  const Real max2 = std::min(query.maxRadius2, kLargest);
  Real radius2 = max2;
  if (view.spacing2 && query.k < view.count) {
    const std::uint32_t run = BlockNear(view, p) / (PointTreeView::kSpacingPoints / kBlockPoints);
    radius2 = view.spacing2[run] * Real(query.k) * kFirst;
  }
  for (;; radius2 = radius2 < max2 / kGrowth ? radius2 * kGrowth : max2) {
    if (!(radius2 > 0 && radius2 < max2)) radius2 = max2;
    Candidates candidates(buffer, query.k, radius2);
    CollectFor(view, query, p, &candidates);
    if (candidates.Count() >= query.k || radius2 == max2) return candidates.Finish();
  }
}
