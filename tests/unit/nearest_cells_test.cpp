// SPDX-License-Identifier: BSD-2-Clause
// The index of cells never proves a wrong neighbour, and proves most on the surfaces it was made
// for.
#include "core/spatial/nearest_cells.h"

#include <gtest/gtest.h>

#include "core/math/random.h"

namespace exphoton {
namespace {

// Points on the walls of a box, some walls many times as dense as others, a corner denser still.
struct Walls {
  std::vector<Point3> points;
  std::vector<Normal3> normals;

  static Point3 OnWall(int wall, Real u, Real v) {
    const int axis = wall / 2;
    Point3 p;
    p[axis] = wall % 2 ? Real(3) : Real(-1);
    p[(axis + 1) % 3] = 4 * u - 1;
    p[(axis + 2) % 3] = 4 * v - 1;
    return p;
  }
  void Add(int wall, Real u, Real v) {
    points.push_back(OnWall(wall, u, v));
    normals.emplace_back();
    normals.back()[wall / 2] = wall % 2 ? Real(-1) : Real(1);
  }
  explicit Walls(int count) {
    RandomStream random(5);
    const auto u = [&] { return random.Uniform(); };
    for (int i = 0; i < count; ++i) {
      const int wall = i % 32 < 26 ? i % 2 : 2 + i % 4;
      if (i % 5 == 0) {
        Add(wall, u() / 20, u() / 20);
      } else {
        Add(wall, u(), u());
      }
    }
  }
};

NearPoint BruteForce(const PointKdTree& tree, const Point3& p) {
  NearPoint best{kInfinity, 0};
  for (std::uint32_t i = 0; i < tree.Size(); ++i)
    best = std::min(best, NearPoint{DistanceSquared(tree.Point(i), p), i});
  return best;
}

std::vector<Normal3> InTreeOrder(const PointKdTree& tree, const std::vector<Normal3>& normals) {
  std::vector<Normal3> ordered;
  for (std::uint32_t i : tree.Order()) ordered.push_back(normals[i]);
  return ordered;
}

TEST(NearestCells, ProveOnlyTrueNeighboursAndMostOfThem) {
  const Walls walls(4000);
  const PointKdTree tree(walls.points);
  ThreadPool threads(2);
  const NearestCells cells(tree, InTreeOrder(tree, walls.normals), threads);
  RandomStream random(6);
  int proven = 0;
  constexpr int kQueries = 3000;
  for (int i = 0; i < kQueries; ++i) {
    Point3 p = Walls::OnWall(i % 6, random.Uniform(), random.Uniform());
    if (i % 10 == 0) p = p + Vector3(random.Uniform(), random.Uniform(), random.Uniform());
    const auto* cell = cells.Around(p);
    if (!cell) continue;
    NearPoint best{kInfinity, 0};
    for (std::uint32_t id : cell->ids)
      best = std::min(best, NearPoint{DistanceSquared(tree.Point(id), p), id});
    if (!cell->Proves(best.distance2, p)) continue;
    ++proven;
    const NearPoint expected = BruteForce(tree, p);
    ASSERT_EQ(best.index, expected.index) << i;
    ASSERT_EQ(best.distance2, expected.distance2) << i;
  }
  EXPECT_GT(proven, kQueries * 3 / 4);
}

TEST(NearestCells, AreTheSameForAnyNumberOfThreads) {
  const Walls walls(3000);
  const PointKdTree tree(walls.points);
  ThreadPool one(1), three(3);
  const NearestCells a(tree, InTreeOrder(tree, walls.normals), one);
  const NearestCells b(tree, InTreeOrder(tree, walls.normals), three);
  EXPECT_EQ(a.MemoryBytes(), b.MemoryBytes());
  for (const Point3& p : walls.points) {
    const auto *x = a.Around(p), *y = b.Around(p);
    ASSERT_EQ(x == nullptr, y == nullptr);
    if (!x) continue;
    EXPECT_EQ(x->middle, y->middle);
    EXPECT_EQ(x->clear, y->clear);
    EXPECT_TRUE(std::equal(std::begin(x->ids), std::end(x->ids), std::begin(y->ids)));
  }
}

TEST(NearestCells, AreFiniteWorkForPointsThatLieTogetherOrNowhere) {
  ThreadPool threads(1);
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (const int layout : {0, 1, 2, 3}) {
    std::vector<Point3> points;
    for (int i = 0; i < 5000; ++i) {
      Point3 p(1, 2, 3);
      if (layout == 1) p.x = Real(i);
      if (layout == 2 && i == 0) p = Point3(Real(1e30), Real(-1e30), 0);
      if (layout == 3) p = Point3(Real(i % 70), Real(i / 70), 0) * Real(1e-30);
      points.push_back(p);
    }
    const PointKdTree tree(points);
    const std::vector<Normal3> normals(points.size(), Normal3(0, 0, 1));
    const NearestCells cells(tree, normals, threads);
    EXPECT_LT(cells.MemoryBytes(), std::size_t(64) << 20) << layout;
    for (const Point3& p :
         {Point3(1, 2, 3), Point3(nan, 0, 0), Point3(kInfinity, 0, 0), Point3()}) {
      const auto* cell = cells.Around(p);
      EXPECT_TRUE(!cell || cell->clear > 0);
    }
  }
  EXPECT_EQ(NearestCells().Around({0, 0, 0}), nullptr);
}

}  // namespace
}  // namespace exphoton
