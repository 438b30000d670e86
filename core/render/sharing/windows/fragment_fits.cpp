// SPDX-License-Identifier: BSD-2-Clause
// FragmentFits: one fit after the other, row by row.
#include "core/render/sharing/windows/fragment_fits.h"

#include <algorithm>

namespace exphoton {

static_assert(sizeof(FragmentFit) <= sizeof(GatherFragment));  // GatherFragments::BytesPerPixel

FragmentFits::FragmentFits(const Source& source, const PixelBounds& region, const GroupOf& groupOf,
                           ThreadPool* threads)
    : rows_(source.rows), fits_(source.rows.Count() + 1) {
  const PixelBounds& bounds = source.gathers.Bounds();
  const int y0 = std::max(region.y0, bounds.y0), y1 = std::min(region.y1, bounds.y1);
  const int x0 = std::max(region.x0, bounds.x0), x1 = std::min(region.x1, bounds.x1);
  std::vector<FitNeighbours> scratch(std::size_t(threads->Count()));
  threads->For(std::max(y1 - y0, 0), [&](std::int64_t row, int worker) {
    for (int x = x0; x < x1; ++x) {
      const Point2i pixel{x, y0 + int(row)};
      const auto& fragments = source.gathers.At(pixel).fragments;
      const std::optional<int> group = groupOf ? groupOf(pixel) : std::nullopt;
      for (std::size_t i = 0; i < fragments.size(); ++i) {
        const WindowFit window(source.rows, source.windows, {pixel, fragments[i]},
                               &scratch[std::size_t(worker)]);
        FragmentFit& fit = fits_[rows_.First(pixel) + i];
        fit = {window.To(FragmentRows::All), window.Window(), std::nullopt};
        if (group && fragments[i].HasGroup(*group)) fit.checked = window.Difference(*group);
      }
    }
  });
}

}  // namespace exphoton
