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

  // Takes the pixels of a grid: every `stride`-th one along both axes, counted from pixel 0,0, so
  // that the grid does not depend on a crop window. The stride is a power of 2.
  explicit FragmentRows(const GatherFragments& gathers, int stride = 1);

  const Real* At(Column column) const { return columns_[std::size_t(column)].data(); }
  // Calls use(range) for each row of the pixels within `reach` pixels of this one along both axes.
  struct Range {
    std::size_t begin = 0, end = 0;  // fragments
  };
  template <class Use>
  void ForRowsAround(Point2i pixel, int reach, const Use& use) const {
    const int x0 = std::clamp(CeilDivide(pixel.x - reach), grid_.x0, grid_.x1),
              x1 = std::clamp(FloorDivide(pixel.x + reach) + 1, x0, grid_.x1),
              y0 = std::max(CeilDivide(pixel.y - reach), grid_.y0),
              y1 = std::min(FloorDivide(pixel.y + reach) + 1, grid_.y1);
    if (y0 >= y1) return;
    const std::size_t* first = &first_[IndexOf({x0, y0})];
    for (int y = y0; y < y1; ++y, first += grid_.Width()) use(Range{first[0], first[x1 - x0]});
  }
  std::size_t Count() const { return first_.back(); }  // of all fragments
  // Returns the index of the first fragment of a pixel of the grid.
  std::size_t First(Point2i pixel) const {
    return first_[IndexOf({FloorDivide(pixel.x), FloorDivide(pixel.y)})];
  }
  // Calls use(pixel) for all pixels of the grid, in the order of their fragments.
  template <class Use>
  void ForPixels(const Use& use) const {
    for (int y = grid_.y0; y < grid_.y1; ++y)
      for (int x = grid_.x0; x < grid_.x1; ++x) use(Point2i{x << shift_, y << shift_});
  }

 private:
  int FloorDivide(int a) const { return a >> shift_; }
  int CeilDivide(int a) const { return -FloorDivide(-a); }
  std::size_t IndexOf(Point2i inGrid) const {
    return std::size_t(inGrid.y - grid_.y0) * std::size_t(grid_.Width()) +
           std::size_t(inGrid.x - grid_.x0);
  }
  int shift_;                       // log2 of the stride
  PixelBounds grid_;                // in strides
  std::vector<std::size_t> first_;  // by pixel of the grid; one more at the end
  std::array<std::vector<Real>, kColumns> columns_;
};

}  // namespace exphoton
