// SPDX-License-Identifier: BSD-2-Clause
// BoxMean: a mean along rows, then along columns.
#include "core/imaging/film/box_mean.h"

#include <algorithm>

namespace exphoton {

std::vector<float> BoxMean(const std::vector<float>& values, std::size_t width) {
  constexpr std::ptrdiff_t kReach = 2;
  const auto columns = std::ptrdiff_t(width);
  const std::ptrdiff_t rows = std::ptrdiff_t(values.size() / 3) / columns;
  const auto along = [&](const std::vector<float>& from, bool isRow) {
    std::vector<float> to(from.size());
    const std::ptrdiff_t count = isRow ? columns : rows, step = isRow ? 3 : 3 * columns;
    for (std::ptrdiff_t y = 0; y < rows; ++y) {
      for (std::ptrdiff_t x = 0; x < columns; ++x) {
        const std::ptrdiff_t place = isRow ? x : y, at = 3 * (y * columns + x);
        const std::ptrdiff_t first = std::max<std::ptrdiff_t>(place - kReach, 0);
        const std::ptrdiff_t last = std::min(place + kReach, count - 1);
        for (std::ptrdiff_t c = 0; c < 3; ++c) {
          double sum = 0;
          for (std::ptrdiff_t k = first; k <= last; ++k)
            sum += double(from[std::size_t(at + (k - place) * step + c)]);
          to[std::size_t(at + c)] = float(sum / double(last - first + 1));
        }
      }
    }
    return to;
  };
  return along(along(values, true), false);
}

}  // namespace exphoton
