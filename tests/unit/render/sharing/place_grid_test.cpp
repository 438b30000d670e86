// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the places near a fragment with a search of all fragments. The gathers lie on
// a floor, on a wall behind it and on a ball, and their pixels begin left of and above pixel 0,0.
#include "core/render/sharing/windows/place_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr PixelBounds kGridBounds{-10, -7, 30, 26};

GatherRecord RecordAt(Point2 film) {
  const bool isWall = film.y < 8;
  Point3 p = isWall ? Point3{film.x, 8, 8 - film.y} : Point3{film.x, film.y, 0};
  Normal3 n = isWall ? Normal3{0, 1, 0} : Normal3{0, 0, 1};
  const Vector3 fromBall{film.x - 12, film.y - 16, 0};
  if (LengthSquared(fromBall) < 36) {
    p = {film.x, film.y, 3 + std::sqrt(36 - LengthSquared(fromBall))};
    n = Normalize(p - Point3{12, 16, 3});
  }
  return {p, n, n, Spectrum(1), Spectrum(1)};
}

GatherFragments CornerGathers() {
  GatherFragments gathers(kGridBounds, 2);
  RandomStream random(5);
  for (int y = kGridBounds.y0; y < kGridBounds.y1; ++y)
    for (int x = kGridBounds.x0; x < kGridBounds.x1; ++x) {
      for (int i = 0; i < 2; ++i) {
        const Point2 at{Real(x) + random.Uniform(), Real(y) + random.Uniform()};
        gathers.At({x, y}).Add({RecordAt(at)}, at, 1, {GatherGroup({x, y}, i), 1});
      }
      gathers.At({x, y}).Finish();
    }
  return gathers;
}

struct TestPlace : PlaceSpot {
  explicit TestPlace(const PlaceSpot& spot) : PlaceSpot(spot) {}
};

using Weights = std::map<std::pair<std::pair<int, int>, std::size_t>, Real>;

// Returns the weights of all places around a fragment, by pixel and by index in the pixel.
Weights WeightsBySearch(const GatherFragments& gathers, const GatherFragment& around, Real radius) {
  Weights weights;
  for (int y = -4; y < kGridBounds.y1; y += 4)
    for (int x = -8; x < kGridBounds.x1; x += 4)
      for (std::size_t i = 0; i < gathers.At({x, y}).fragments.size(); ++i) {
        const GatherFragment& other = gathers.At({x, y}).fragments[i];
        const Point2 d = other.film - around.film;
        const Real weight = 1 - (d.x * d.x + d.y * d.y) / (radius * radius);
        if (weight > 0 && around.depth == other.depth &&
            LieOnOneSurface(around.p, around.ng, other.p, other.ng))
          weights[{{x, y}, i}] = weight;
      }
  return weights;
}

TEST(PlaceGrid, FindsThePlacesOnTheSurfaceOfAFragment) {
  const GatherFragments gathers = CornerGathers();
  const PlaceGrid<TestPlace> grid(gathers);
  FitNeighbours scratch;
  std::size_t divided = 0, most = 0;
  for (int y = kGridBounds.y0; y < kGridBounds.y1; ++y)
    for (int x = kGridBounds.x0; x < kGridBounds.x1; ++x) {
      const auto& fragments = gathers.At({x, y}).fragments;
      divided += fragments.size() > 1;
      for (const GatherFragment& fragment : fragments) {
        const Weights wanted = WeightsBySearch(gathers, fragment, 6);
        Weights found;
        grid.ForNearby({FitTarget(fragment), {x, y}, 6}, &scratch,
                       [&](const TestPlace& place, Real weight) {
                         found[{{place.pixel.x, place.pixel.y}, place.fragment}] = weight;
                       });
        EXPECT_EQ(found, wanted) << x << ", " << y;
        most = std::max(most, found.size());
      }
    }
  EXPECT_GT(divided, 10U);  // pixels with two surfaces
  EXPECT_GE(most, 8U);
}

TEST(PlaceGrid, HoldsAConditionForAllPlacesAround) {
  const PlaceGrid<TestPlace> grid(CornerGathers());
  const auto isNot = [](Point2i pixel) {
    return [pixel](const TestPlace& place) {
      return place.pixel.x != pixel.x || place.pixel.y != pixel.y;
    };
  };
  for (const int edge : {2, 14}) {
    EXPECT_FALSE(grid.HoldsAround({edge, 8}, 6, isNot({8, 8})));
    EXPECT_FALSE(grid.HoldsAround({8, edge}, 6, isNot({8, 8})));
  }
  for (const int beyond : {1, 15}) {
    EXPECT_TRUE(grid.HoldsAround({beyond, 8}, 6, isNot({8, 8})));
    EXPECT_TRUE(grid.HoldsAround({8, beyond}, 6, isNot({8, 8})));
  }
  EXPECT_FALSE(grid.HoldsAround({-10, -7}, 6, isNot({-8, -4})));
}

}  // namespace
}  // namespace exphoton
