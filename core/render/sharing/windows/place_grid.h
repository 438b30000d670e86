// SPDX-License-Identifier: BSD-2-Clause
// PlaceGrid holds the fragments of every fourth pixel, with what is chosen for their surroundings.
// The grid is anchored at pixel 0,0, so that it does not depend on a crop window.
#pragma once

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"
#include "core/render/sharing/gather_fragments.h"

namespace exphoton {

// Where a fragment is.
struct PlaceSpot {
  PlaceSpot(Point2i aPixel, const GatherFragment& fragment)
      : pixel(aPixel), film(fragment.film), p(fragment.p), ng(fragment.ng), depth(fragment.depth) {}
  bool IsOnSurfaceOf(const PlaceSpot& other) const {
    return depth == other.depth && LieOnOneSurface(p, ng, other.p, other.ng);
  }
  // Returns 1 - (d / radius)^2 for the distance d on the film.
  Real WeightOf(Point2 at, Real radius) const {
    const Point2 d = at - film;
    return 1 - (d.x * d.x + d.y * d.y) / (radius * radius);
  }

  Point2i pixel;
  Point2 film;
  Point3 p;
  Normal3 ng;
  int depth;
};

// Place is derived from PlaceSpot.
template <class Place>
class PlaceGrid {
 public:
  static constexpr int kStride = 4;  // pixels

  // Calls make(pixel, fragment, worker) for the fragments of all grid pixels, which returns a
  // Place.
  template <class Make>
  PlaceGrid(const GatherFragments& gathers, ThreadPool* threads, Make make)
      : x0_(CeilDivide(gathers.Bounds().x0)),
        y0_(CeilDivide(gathers.Bounds().y0)),
        columns_(std::max(CeilDivide(gathers.Bounds().x1) - x0_, 0)),
        rows_(std::max(CeilDivide(gathers.Bounds().y1) - y0_, 0)),
        cells_(std::size_t(columns_) * std::size_t(rows_)) {
    threads->For(rows_, [&](std::int64_t row, int worker) {
      for (int column = 0; column < columns_; ++column) {
        const Point2i pixel{(x0_ + column) * kStride, (y0_ + int(row)) * kStride};
        for (const GatherFragment& fragment : gathers.At(pixel).fragments)
          At(column, int(row)).push_back(make(pixel, fragment, worker));
      }
    });
  }

  // Calls use(place, worker) for all places.
  template <class Use>
  void ForAll(ThreadPool* threads, const Use& use) {
    threads->For(rows_, [&](std::int64_t row, int worker) {
      for (int column = 0; column < columns_; ++column)
        for (Place& place : At(column, int(row))) use(&place, worker);
    });
  }

  // Calls use(place, weight) for the places within `radius` pixels on the surface of a spot.
  template <class Use>
  void ForNearby(const PlaceSpot& spot, Real radius, const Use& use) const {
    const int reach = int(radius);
    const int firstX = std::max(CeilDivide(spot.pixel.x - reach) - x0_, 0),
              firstY = std::max(CeilDivide(spot.pixel.y - reach) - y0_, 0),
              lastX = std::min(FloorDivide(spot.pixel.x + reach) - x0_, columns_ - 1),
              lastY = std::min(FloorDivide(spot.pixel.y + reach) - y0_, rows_ - 1);
    for (int y = firstY; y <= lastY; ++y)
      for (int x = firstX; x <= lastX; ++x)
        for (const Place& place : cells_[IndexOf(x, y)])
          if (const Real weight = spot.WeightOf(place.film, radius);
              weight > 0 && spot.IsOnSurfaceOf(place))
            use(place, weight);
  }

 private:
  static int FloorDivide(int a) { return a >= 0 ? a / kStride : -((kStride - 1 - a) / kStride); }
  static int CeilDivide(int a) { return -FloorDivide(-a); }
  std::size_t IndexOf(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }
  std::vector<Place>& At(int column, int row) { return cells_[IndexOf(column, row)]; }

  int x0_, y0_, columns_, rows_;  // in grid pixels
  std::vector<std::vector<Place>> cells_;
};

}  // namespace exphoton
