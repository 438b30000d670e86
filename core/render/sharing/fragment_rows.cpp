// SPDX-License-Identifier: BSD-2-Clause
// FragmentRows: copies the fragments of each pixel into columns.
#include "core/render/sharing/fragment_rows.h"

#include <bit>
#include <stdexcept>

namespace exphoton {

FragmentRows::FragmentRows(const GatherFragments& gathers, int stride)
    : shift_(std::countr_zero(unsigned(stride))) {
  if (!std::has_single_bit(unsigned(stride)))
    throw std::invalid_argument("the stride is no power of 2");
  const PixelBounds& bounds = gathers.Bounds();
  grid_ = {CeilDivide(bounds.x0), CeilDivide(bounds.y0), CeilDivide(bounds.x1),
           CeilDivide(bounds.y1)};
  first_.push_back(0);
  ForPixels(
      [&](Point2i pixel) { first_.push_back(first_.back() + gathers.At(pixel).fragments.size()); });
  for (auto& column : columns_) column.resize(first_.back() + kPadding);
  std::array<Real*, kColumns> columns;
  for (std::size_t c = 0; c < kColumns; ++c) columns[c] = columns_[c].data();
  std::size_t at = 0;
  const auto setRecords = [&](std::size_t first, Real count, const Spectrum& light) {
    const Real values[] = {count, light.r, light.g, light.b};
    for (std::size_t c = 0; c < 4; ++c) columns[first + c][at] = values[c];
  };
  ForPixels([&](Point2i pixel) {
    for (const GatherFragment& f : gathers.At(pixel).fragments) {
      const Real values[Group0] = {f.film.x, f.film.y, f.p.x, f.p.y, f.p.z, f.ng.x,
                                   f.ng.y,   f.ng.z,   f.n.x, f.n.y, f.n.z, Real(f.depth)};
      for (std::size_t c = 0; c < Group0; ++c) columns[c][at] = values[c];
      for (int group = 0; group < kGatherGroups; ++group)
        setRecords(OfGroup(group), f.count[std::size_t(group)], f.lights[std::size_t(group)]);
      setRecords(All, f.Count(), f.Light());
      ++at;
    }
  });
}

}  // namespace exphoton
