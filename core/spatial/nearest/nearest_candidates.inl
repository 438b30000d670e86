// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search.inl: the candidates that a k-nearest-neighbour search has found so far,
// and the selection of the k nearest among them.

// Stores candidates by ascending index. A full buffer is cut back to the k nearest.
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
  // Pads with infinite distances, so that the buffer can be read in vectors of 16 lanes.
  void PadToVector() { Real16::All(kInfinity).StoreUnaligned(distance2_ + count_); }

  // Returns the squared distance of the k-th nearest of more than k candidates. On a surface,
  // squared distances are about uniformly distributed, so pivots are interpolated linearly.
  // KthBetween then selects among the candidates left between the last two pivots.
  Real KthDistance2() const {
    constexpr int kTries = 6;
    // The k-th distance is in (low2, high2]. Candidates kept by an earlier cut may lie one step
    // beyond limit2_, so high2 includes them.
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

  // Returns the rank-th smallest squared distance in (low2, high2].
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
    // Most distances are equal or extremely uneven. Bisect the bit patterns, which have the same
    // order as the numbers because squared distances are not negative.
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

  // Keeps the k nearest. Later candidates have higher indices and lose ties, so they must be
  // strictly nearer: limit2_ is the number just below the k-th distance.
  void Cut() {
    PadToVector();
    const Real kth2 = KthDistance2();
    std::size_t spare = k_ - CountWithin(NextDownFrom(kth2));  // kept candidates at distance kth2
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
