// SPDX-License-Identifier: BSD-2-Clause
// Selection of the nearest by interpolated pivots.
#include "core/spatial/nearest_set.h"

#include <cassert>

namespace exphoton {

void SelectNearest(std::span<NearPoint> points, std::size_t k) {
  assert(k >= 1 && k <= points.size());
  // The k-th is within [low, high), below there are nearer ones, above farther ones.
  std::size_t low = 0, high = points.size();
  constexpr std::size_t kFew = 12;
  constexpr int kTries = 8;
  Real nearest2 = kInfinity, farthest2 = 0;
  for (const NearPoint& point : points) {
    nearest2 = point.distance2 < nearest2 ? point.distance2 : nearest2;
    farthest2 = point.distance2 > farthest2 ? point.distance2 : farthest2;
  }
  for (int i = 0; i < kTries && high - low > kFew; ++i) {
    const Real share = (Real(k - low) - Real(.5)) / Real(high - low);
    const Real pivot2 = nearest2 + (farthest2 - nearest2) * share;
    std::size_t middle = low;
    for (std::size_t j = low; j < high; ++j) {
      const NearPoint point = points[j];
      points[j] = points[middle];
      points[middle] = point;
      middle += point.distance2 <= pivot2;
    }
    if (middle == low || middle == high) break;  // nothing gained: equal or unevenly spread
    if (middle >= k) {
      high = middle, farthest2 = pivot2;
    } else {
      low = middle, nearest2 = pivot2;
    }
  }
  const auto begin = points.begin();
  std::nth_element(begin + std::ptrdiff_t(low), begin + std::ptrdiff_t(k - 1),
                   begin + std::ptrdiff_t(high));
}

}  // namespace exphoton
