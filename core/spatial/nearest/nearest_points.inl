// SPDX-License-Identifier: BSD-2-Clause
// Part of nearest_search.inl: the search for the k nearest points.

// Offers every point within the limit to the candidates. measureBoxes(node) returns the squared
// distances of the children. measure(block, &distance2) returns the mask of the lanes that may be
// offered.
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
// found, so the search rarely visits far more than k points.
NearPoints Nearest(const PointTreeView& view, const NearestQuery& query, const NearBuffer& buffer) {
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
