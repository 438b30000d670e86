// SPDX-License-Identifier: BSD-2-Clause
// These tests compare searches in a point BVH with brute force, for every SIMD target.
#include "core/spatial/point_tree.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>

#include "core/math/sampling/random.h"
#include "tests/support/point_trees.h"

namespace exphoton {
namespace {

enum class Layout { Random, Grid, Collinear, Coincident, Plane, Huge };
constexpr Layout kLayouts[] = {Layout::Random,     Layout::Grid,  Layout::Collinear,
                               Layout::Coincident, Layout::Plane, Layout::Huge};

std::vector<Point3> MakePoints(Layout layout, int count, RandomStream* random) {
  std::vector<Point3> points;
  for (int i = 0; i < count; ++i) {
    const Point3 p{random->Uniform(), random->Uniform(), random->Uniform()};
    switch (layout) {
      case Layout::Random:
        points.push_back(p);
        break;
      case Layout::Grid:
        points.push_back({Real(i % 7), Real(i / 7 % 7), Real(i / 49)});
        break;
      case Layout::Collinear:
        points.push_back({p.x, 2 * p.x, 1});
        break;
      case Layout::Coincident:
        points.push_back({1, 2, 3});
        break;
      case Layout::Plane:
        points.push_back({p.x, p.y, 0});
        break;
      case Layout::Huge:
        points.push_back(p * Real(1e6));
        break;
    }
  }
  return points;
}

std::vector<TestDisk> MakeDisks(Layout layout, int count, RandomStream* random) {
  std::vector<TestDisk> disks;
  for (const Point3& p : MakePoints(layout, count, random)) {
    const auto u = [&] { return 2 * random->Uniform() - 1; };
    disks.push_back({p, EncodeOctahedral(NormalizeOr({u(), u(), u()}, {0, 0, 1})),
                     random->Uniform() * (layout == Layout::Huge ? Real(1e11) : Real(.1))});
  }
  return disks;
}

Point3 QueryPoint(Layout layout, const std::vector<Point3>& points, int i, RandomStream* random) {
  if (i < 3 && !points.empty()) return points[std::size_t(i) % points.size()];
  const Point3 p = MakePoints(Layout::Random, 1, random)[0];
  return layout == Layout::Huge ? p * Real(1e6) : p;
}

TEST(PointTree, FindsTheSameNeighboursAsBruteForce) {
  RandomStream random(7);
  for (const Layout layout : kLayouts)
    for (const int count : {0, 1, 2, 15, 16, 17, 33, 100, 343, 4500}) {
      const auto points = MakePoints(layout, count, &random);
      const TestPointTree tree(points);
      ASSERT_EQ(tree.Tree().Size(), std::size_t(count));
      for (const int k : {1, 2, 5, 50, count + 5})
        for (int i = 0; i < (count > 1000 ? 4 : 10); ++i) {
          NearestQuery query;
          query.p = QueryPoint(layout, points, i, &random);
          query.k = std::uint32_t(k);
          if (i % 2) query.maxRadius2 = Square(layout == Layout::Huge ? Real(1e5) : Real(.2));
          const auto expected = tree.NearestByBruteForce(query);
          for (const NearestSearch* search : AvailableNearestSearches())
            ASSERT_EQ(tree.Nearest(*search, query), expected)
                << search->name << " layout " << int(layout) << " count " << count << " k " << k;
        }
    }
}

TEST(PointTree, FindsTheSameNeighboursAsBruteForceInAFlattenedRegionOnOneSide) {
  RandomStream random(8);
  for (const Layout layout : kLayouts)
    for (const bool isOneSided : {false, true}) {
      const auto disks = MakeDisks(layout, 2000, &random);
      std::vector<Point3> points;
      for (const TestDisk& disk : disks) points.push_back(disk.p);
      const TestPointTree tree(disks);
      for (int i = 0; i < 20; ++i) {
        NearestQuery query;
        query.p = QueryPoint(layout, points, i, &random);
        query.k = 30;
        query.n = DecodeOctahedral(disks[std::size_t(i)].direction);
        query.isFlattened = true;
        query.steepness = 2;
        query.isOneSided = isOneSided;
        const auto expected = tree.NearestByBruteForce(query);
        for (const NearestSearch* search : AvailableNearestSearches())
          ASSERT_EQ(tree.Nearest(*search, query), expected) << search->name << int(layout);
      }
    }
}

TEST(PointTree, FindsTheDiskThatBruteForceFinds) {
  RandomStream random(9);
  int found = 0;
  for (const Layout layout : kLayouts)
    for (const int count : {0, 1, 40, 3000})
      for (int i = 0; i < 40; ++i) {
        static std::vector<TestDisk> disks;
        static std::vector<Point3> points;
        static std::unique_ptr<TestPointTree> tree;
        if (i == 0) {
          disks = MakeDisks(layout, count, &random);
          points.clear();
          for (const TestDisk& disk : disks) points.push_back(disk.p);
          tree = std::make_unique<TestPointTree>(disks);
        }
        const ClosestQuery query{QueryPoint(layout, points, i, &random), {0, 0, 1}};
        const ClosestLimits limits{i % 3 == 0 ? Real(-.5) : Real(.7),
                                   layout == Layout::Huge ? Real(1e11) : Real(.1)};
        const ClosestPoint expected = tree->ClosestByBruteForce(query, limits);
        found += expected.index != ClosestPoint::kNone;
        for (const NearestSearch* search : AvailableNearestSearches()) {
          // The query runs by itself and in a batch.
          for (const std::size_t queries : {1, 7}) {
            std::vector<ClosestQuery> all(queries, ClosestQuery{{1, 2, 3}, {0, 0, 1}});
            all.back() = query;
            std::vector<ClosestPoint> closest(queries);
            search->closest(tree->View(), limits, all, closest.data());
            ASSERT_EQ(closest.back().index, expected.index) << search->name << int(layout);
            ASSERT_EQ(closest.back().distance2, expected.distance2);
          }
        }
      }
  EXPECT_GT(found, 150);
}

TEST(PointTree, FindsTheDisksThatBruteForceFindsManyAtOnce) {
  RandomStream random(10);
  int found = 0;
  for (const Layout layout : kLayouts)
    for (const int count : {1, 17, 300, 6000})
      for (const Real minCosine : {Real(-.5), Real(.7)}) {
        const std::vector<TestDisk> disks = MakeDisks(layout, count, &random);
        std::vector<Point3> points;
        for (const TestDisk& disk : disks) points.push_back(disk.p);
        const TestPointTree tree(disks);
        const ClosestLimits limits{minCosine, layout == Layout::Huge ? Real(1e11) : Real(.1)};
        std::vector<ClosestQuery> queries;
        std::vector<ClosestPoint> expected;
        for (int i = 0; i < 41; ++i) {
          Normal3 n{0, 0, 1};
          if (i % 4 == 1) n = DecodeOctahedral(disks[std::size_t(i % count)].direction);
          queries.push_back({QueryPoint(layout, points, i, &random), n});
          if (i % 13 == 12) queries.back().p.x = kInfinity;
          expected.push_back(tree.ClosestByBruteForce(queries.back(), limits));
          found += expected.back().index != ClosestPoint::kNone;
        }
        for (const NearestSearch* search : AvailableNearestSearches()) {
          std::vector<ClosestPoint> closest(queries.size());
          search->closest(tree.View(), limits, queries, closest.data());
          for (std::size_t i = 0; i < queries.size(); ++i) {
            ASSERT_EQ(closest[i].index, expected[i].index) << search->name << int(layout);
            ASSERT_EQ(closest[i].distance2, expected[i].distance2);
          }
        }
      }
  EXPECT_GT(found, 400);
}

// From the centre of a sphere all points are about equally near, so more boxes remain than the
// traversal's list can hold.
TEST(PointTree, FindsTheDiskThatBruteForceFindsWhereAllAreAsNear) {
  RandomStream random(14);
  std::vector<TestDisk> disks = MakeDisks(Layout::Random, 20000, &random);
  for (TestDisk& disk : disks) {
    const Vector3 w = NormalizeOr(disk.p - Point3(Real(.5), Real(.5), Real(.5)), {1, 0, 0});
    disk.p = Point3() + w * (1 + Real(.001) * random.Uniform());
    disk.radius2 = 4;
    disk.direction = EncodeOctahedral({0, 0, 1});
  }
  const TestPointTree tree(disks);
  const ClosestLimits limits{0, 4};
  std::vector<ClosestQuery> queries;
  for (int i = 0; i < 16; ++i)
    queries.push_back({Point3() + Vector3(Real(1e-5) * Real(i), 0, 0), {0, 0, 1}});
  for (const NearestSearch* search : AvailableNearestSearches()) {
    std::vector<ClosestPoint> closest(queries.size());
    search->closest(tree.View(), limits, queries, closest.data());
    for (std::size_t i = 0; i < queries.size(); ++i)
      ASSERT_EQ(closest[i].index, tree.ClosestByBruteForce(queries[i], limits).index);
  }
}

TEST(PointTree, HoldsEveryPointOnce) {
  RandomStream random(11);
  const auto points = MakePoints(Layout::Random, 1000, &random);
  const TestPointTree tree(points);
  const auto less = [](const Point3& a, const Point3& b) { return a.x < b.x; };
  std::set<Point3, decltype(less)> given(points.begin(), points.end(), less), seen(less);
  for (std::uint32_t i = 0; i < tree.Tree().Size(); ++i) seen.insert(tree.Tree().Position(i));
  EXPECT_EQ(seen.size(), points.size());
  EXPECT_TRUE(std::equal(seen.begin(), seen.end(), given.begin()));
}

TEST(PointTree, IsTheSameForAnyNumberOfThreads) {
  RandomStream random(12);
  const auto points = MakePoints(Layout::Plane, 20000, &random);
  const TestPointTree one(points, 1), three(points, 3);
  for (std::uint32_t i = 0; i < one.Tree().Size(); ++i)
    ASSERT_EQ(one.Tree().Position(i), three.Tree().Position(i));
}

TEST(PointTree, MadeWithOthersAtOnceIsTheSameAsAlone) {
  RandomStream random(13);
  const auto pointsOf = [&](int count) { return MakePoints(Layout::Random, count, &random); };
  const std::vector<Point3> sets[] = {pointsOf(5000), {}, pointsOf(7), pointsOf(900)};
  const auto storeOf = [](const std::vector<Point3>& points) {
    BlockStore<PointBlock> store;
    for (const Point3& p : points) {
      const OrientedPoint point{p, 0};
      store.Append({&point, 1});
    }
    return store;
  };
  ThreadPool one(1), three(3);
  std::vector<BlockStore<PointBlock>> stores;
  for (const auto& points : sets) stores.push_back(storeOf(points));
  const auto trees = PointTree<PointBlock>::MakeAll(stores, three);
  for (std::size_t set = 0; set < std::size(sets); ++set) {
    const PointTree<PointBlock> alone(storeOf(sets[set]), one);
    ASSERT_EQ(trees[set].Size(), sets[set].size());
    EXPECT_EQ(trees[set].MemoryBytes(), alone.MemoryBytes());
    for (std::uint32_t i = 0; i < alone.Size(); ++i)
      ASSERT_EQ(trees[set].Position(i), alone.Position(i)) << set << " " << i;
  }
}

TEST(PointTree, WithoutPointsOrWithANanQueryFindsNothing) {
  RandomStream random(13);
  const TestPointTree empty(std::vector<Point3>{});
  const TestPointTree tree(MakePoints(Layout::Random, 100, &random));
  NearestQuery query;
  query.k = 5;
  for (const NearestSearch* search : AvailableNearestSearches()) {
    EXPECT_TRUE(empty.Nearest(*search, query).empty());
    for (const Real bad : {std::numeric_limits<Real>::quiet_NaN(), kInfinity}) {
      NearestQuery wrong = query;
      wrong.p.y = bad;
      EXPECT_TRUE(tree.Nearest(*search, wrong).empty());
      const ClosestQuery place{wrong.p, {0, 0, 1}};
      ClosestPoint closest;
      search->closest(tree.View(), {0, 1}, {&place, 1}, &closest);
      EXPECT_EQ(closest.index, ClosestPoint::kNone);
    }
  }
}

// Visiting every one of the coincident points would take minutes.
TEST(PointTree, OfManyCoincidentPointsFindsTheFirstAtOnce) {
  const TestPointTree tree(std::vector<Point3>(300000, Point3(1, 2, 3)));
  NearestQuery query;
  query.k = 50;
  for (const Real x : {Real(1), Real(2)}) {
    query.p = {x, 2, 3};
    for (int i = 0; i < 2000; ++i) {
      const auto near = tree.Nearest(FastestNearestSearch(), query);
      ASSERT_EQ(near.size(), 50u);
      ASSERT_EQ(near.back().index, 49u);
      const ClosestQuery place{query.p, {0, 0, 1}};
      const std::vector<ClosestQuery> places(16, place);
      for (const std::size_t queries : {std::size_t(1), places.size()}) {
        std::vector<ClosestPoint> closest(queries);
        FastestNearestSearch().closest(tree.View(), {0, 9}, {places.data(), queries},
                                       closest.data());
        for (const ClosestPoint& each : closest) ASSERT_EQ(each.index, 0u);
      }
    }
  }
}

TEST(Octahedral, KeepsTheAxesAndIsCloseEverywhere) {
  for (const Vector3& axis : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    for (const Real sign : {Real(-1), Real(1)})
      EXPECT_EQ(DecodeOctahedral(EncodeOctahedral(axis * sign)), axis * sign);
  RandomStream random(17);
  for (int i = 0; i < 100000; ++i) {
    const auto u = [&] { return 2 * random.Uniform() - 1; };
    const Vector3 v = NormalizeOr({u(), u(), u()}, {0, 0, 1});
    ASSERT_LT(Distance(DecodeOctahedral(EncodeOctahedral(v)), v), 7e-5);
  }
}

TEST(Octahedral, WithANoteKeepsItAndStaysClose) {
  RandomStream random(18);
  for (int i = 0; i < 100000; ++i) {
    const auto u = [&] { return 2 * random.Uniform() - 1; };
    Vector3 v(u(), u(), u());
    if (i % 4 == 0) v[i / 4 % 3] = 0;  // on the folds and edges of the octahedral map
    if (i % 8 == 0) v[i / 8 % 3] = 0;
    v = NormalizeOr(v, {0, 0, -1});
    const auto payload = std::uint8_t(i);
    const std::uint32_t code = EncodeOctahedral(v, payload);
    ASSERT_EQ(OctahedralPayload(code), payload);
    ASSERT_LT(Distance(DecodeOctahedral(code), v), 1.2e-3);
  }
}

}  // namespace
}  // namespace exphoton
