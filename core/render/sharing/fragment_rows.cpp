// SPDX-License-Identifier: BSD-2-Clause
// FragmentRows: copies the fragments of each pixel into columns.
#include "core/render/sharing/fragment_rows.h"

#include <algorithm>

namespace exphoton {

FragmentRows::FragmentRows(const GatherFragments& gathers) : bounds_(gathers.Bounds()) {
  first_.push_back(0);
  for (int y = bounds_.y0; y < bounds_.y1; ++y)
    for (int x = bounds_.x0; x < bounds_.x1; ++x)
      first_.push_back(first_.back() + gathers.At({x, y}).fragments.size());
  for (auto& column : columns_) column.resize(first_.back() + kPadding);
  std::size_t at = 0;
  for (int y = bounds_.y0; y < bounds_.y1; ++y) {
    for (int x = bounds_.x0; x < bounds_.x1; ++x) {
      for (const GatherFragment& f : gathers.At({x, y}).fragments) {
        const Real values[Group0] = {f.film.x, f.film.y, f.p.x, f.p.y, f.p.z, f.ng.x,
                                     f.ng.y,   f.ng.z,   f.n.x, f.n.y, f.n.z, Real(f.depth)};
        for (std::size_t c = 0; c < Group0; ++c) columns_[c][at] = values[c];
        for (int group = 0; group < kGatherGroups; ++group)
          SetRecords(OfGroup(group), at, f.count[std::size_t(group)], f.lights[std::size_t(group)]);
        SetRecords(All, at, f.Count(), f.Light());
        ++at;
      }
    }
  }
}

void FragmentRows::SetRecords(Column first, std::size_t at, Real count, const Spectrum& light) {
  const Real values[] = {count, light.r, light.g, light.b};
  for (std::size_t c = 0; c < 4; ++c) columns_[std::size_t(first) + c][at] = values[c];
}

FragmentRows::Range FragmentRows::Fragments(int x0, int x1, int y) const {
  if (y < bounds_.y0 || y >= bounds_.y1) return {};
  x0 = std::clamp(x0, bounds_.x0, bounds_.x1);
  x1 = std::clamp(x1, x0, bounds_.x1);
  const std::size_t row = IndexOf({bounds_.x0, y});
  return {first_[row + std::size_t(x0 - bounds_.x0)], first_[row + std::size_t(x1 - bounds_.x0)]};
}

}  // namespace exphoton
