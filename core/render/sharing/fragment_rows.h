// SPDX-License-Identifier: BSD-2-Clause
// FragmentRows is a structure of arrays of all fragments of a picture, row by row of its pixels, so
// that the fragments of neighbouring pixels of a row are neighbours in memory.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/render/sharing/gather_fragments.h"

namespace exphoton {

class FragmentRows {
 public:
  static constexpr std::size_t kPadding = 16;  // rows can be read this far beyond their end

  enum Column {
    X,
    Y,
    Px,
    Py,
    Pz,
    Gx,
    Gy,
    Gz,
    Nx,
    Ny,
    Nz,
    Depth,
    Group0,  // number of records, and R, G, B of their sum; each of the four groups has four
             // columns
    All = Group0 + 4 * kGatherGroups,  // the same for all groups together
    kColumns = All + 4
  };
  // Returns the first column of a group.
  static Column OfGroup(int group) { return Column(Group0 + 4 * group); }

  explicit FragmentRows(const GatherFragments& gathers);

  const Real* At(Column column) const { return columns_[std::size_t(column)].data(); }
  // Returns the range of the fragments of pixels x0 to x1 - 1 of row y, clipped to the picture.
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  Range Fragments(int x0, int x1, int y) const {
    if (y < bounds_.y0 || y >= bounds_.y1) return {};
    x0 = std::clamp(x0, bounds_.x0, bounds_.x1);
    x1 = std::clamp(x1, x0, bounds_.x1);
    const std::size_t row = IndexOf({bounds_.x0, y});
    return {first_[row + std::size_t(x0 - bounds_.x0)], first_[row + std::size_t(x1 - bounds_.x0)]};
  }
  std::size_t Count() const { return first_.back(); }  // of all fragments
  std::size_t First(Point2i pixel) const { return first_[IndexOf(pixel)]; }

 private:
  std::size_t IndexOf(Point2i pixel) const {
    return std::size_t(pixel.y - bounds_.y0) * std::size_t(bounds_.Width()) +
           std::size_t(pixel.x - bounds_.x0);
  }
  PixelBounds bounds_;
  std::vector<std::size_t> first_;  // by pixel; one more at the end
  std::array<std::vector<Real>, kColumns> columns_;
};

}  // namespace exphoton
