// SPDX-License-Identifier: BSD-2-Clause
// The point kd-tree and the photon map's search against brute force.
#include "core/spatial/point_kdtree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/math/random.h"
#include "core/spatial/nearest_set.h"
#include "integrators/photon/photon_map.h"

namespace exphoton {
namespace {

enum class Layout { Random, Grid, Collinear, Coincident, Huge };

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
      case Layout::Huge:
        points.push_back(p * Real(1e6));
        break;
    }
  }
  return points;
}

std::vector<NearPoint> BruteForce(const PointKdTree& tree, const Point3& p, std::size_t k) {
  std::vector<NearPoint> all;
  for (std::uint32_t i = 0; i < tree.Size(); ++i)
    all.push_back({DistanceSquared(tree.Point(i), p), i});
  std::sort(all.begin(), all.end());
  all.resize(std::min(k, all.size()));
  return all;
}

std::vector<NearPoint> Search(const PointKdTree& tree, const Point3& p, int k) {
  std::vector<NearPoint> buffer(NearestSet<KeepAll>::BufferSize(k));
  NearestSet nearest(std::span<NearPoint>(buffer), k, KeepAll());
  Real radius2 = kInfinity;
  tree.SearchLeaves(p, &radius2, [&](const PointKdTree::Leaf& leaf, const Real* d2) {
    nearest.OfferLeaf(leaf, d2, &radius2);
  });
  const auto found = nearest.Finish();
  std::vector<NearPoint> sorted(found.begin(), found.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

TEST(PointKdTree, FindsTheSameNeighboursAsBruteForce) {
  RandomStream random(7);
  for (Layout layout :
       {Layout::Random, Layout::Grid, Layout::Collinear, Layout::Coincident, Layout::Huge})
    for (int count : {0, 1, 2, 8, 9, 17, 100, 343}) {
      const auto points = MakePoints(layout, count, &random);
      const PointKdTree tree(points);
      ASSERT_EQ(tree.Size(), std::size_t(count));
      for (int k : {1, 2, 5, count + 5}) {
        for (int query = 0; query < 10; ++query) {
          Point3 p = MakePoints(Layout::Random, 1, &random)[0];
          if (layout == Layout::Huge) p *= Real(1e6);
          if (query < 3 && count > 0) p = points[std::size_t(query) % points.size()];
          const auto expected = BruteForce(tree, p, std::size_t(k));
          const auto found = Search(tree, p, k);
          ASSERT_EQ(found.size(), expected.size());
          for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].distance2, expected[i].distance2);
            EXPECT_EQ(found[i].index, expected[i].index);
          }
        }
      }
    }
}

TEST(SelectNearest, PutsTheNearestFirstWhateverTheirDistances) {
  RandomStream random(23);
  for (int trial = 0; trial < 2000; ++trial) {
    const std::size_t count = 1 + std::size_t(random.Uniform() * 200);
    const std::size_t k = 1 + std::size_t(random.Uniform() * Real(count - 1));
    std::vector<NearPoint> points(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Real u = random.Uniform();
      const Real values[] = {u, std::floor(u * 4), 0, std::pow(u, Real(30)) * Real(1e30)};
      points[i] = {values[trial % 4], i};
    }
    std::shuffle(points.begin(), points.end(), std::minstd_rand(unsigned(trial)));
    auto expected = points;
    std::sort(expected.begin(), expected.end());
    SelectNearest(points, k);
    EXPECT_EQ(points[k - 1].index, expected[k - 1].index) << trial;
    std::sort(points.begin(), points.begin() + std::ptrdiff_t(k));
    for (std::size_t i = 0; i < k; ++i) ASSERT_EQ(points[i].index, expected[i].index) << trial;
  }
}

TEST(PointKdTree, HoldsEveryPointOnce) {
  RandomStream random(11);
  const auto points = MakePoints(Layout::Random, 1000, &random);
  const PointKdTree tree(points);
  std::set<std::uint32_t> seen(tree.Order().begin(), tree.Order().end());
  EXPECT_EQ(seen.size(), points.size());
  for (std::uint32_t i = 0; i < tree.Size(); ++i) EXPECT_EQ(tree.Point(i), points[tree.Order()[i]]);
}

TEST(PointKdTree, WithoutPointsOrWithANanQueryFindsNothing) {
  RandomStream random(13);
  const auto points = MakePoints(Layout::Random, 100, &random);
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  EXPECT_TRUE(Search(PointKdTree(), {0, 0, 0}, 5).empty());
  EXPECT_TRUE(Search(PointKdTree(points), {nan, 0, 0}, 5).empty());
}

PhotonHaul Haul(const std::vector<Photon>& photons, std::int64_t paths) { return {photons, paths}; }

TEST(PhotonMap, WithoutPhotonsAnswersZero) {
  Arena arena;
  const PhotonMap map;
  const auto e = map.EstimateIrradiance({{0, 0, 0}, {0, 0, 1}, 50, 1, true}, &arena);
  EXPECT_TRUE(e.e.IsBlack());
  EXPECT_TRUE(map.Nearest({0, 0, 0}, 50, &arena).empty());
  EXPECT_EQ(map.TypicalRadius(50, &arena), 0);
}

TEST(PhotonMap, OfCoincidentPhotonsStaysFinite) {
  Arena arena;
  std::vector<Photon> photons(100, Photon{{1, 2, 3}, {0, 0, 1}, Spectrum(1)});
  const PhotonMap map(Haul(photons, 10));
  const auto e = map.EstimateIrradiance({{1, 2, 3}, {0, 0, 1}, 50, 1, true}, &arena);
  EXPECT_TRUE(e.e.IsFinite());
  EXPECT_GT(e.e.r, 0);
  EXPECT_GT(e.radius, 0);
}

TEST(PhotonMap, IgnoresPhotonsThatArrivedOnTheOtherSide) {
  Arena arena;
  std::vector<Photon> photons;
  RandomStream random(17);
  for (int i = 0; i < 400; ++i) {
    const Point3 p{random.Uniform(), random.Uniform(), 0};
    photons.push_back({p, {0, 0, i % 2 ? Real(1) : Real(-1)}, i % 2 ? Spectrum(1) : Spectrum(100)});
  }
  const PhotonMap map(Haul(photons, 200));
  const PhotonQuery query{{Real(.5), Real(.5), 0}, {0, 0, 1}, 50, Real(.4), true};
  const auto around = map.Find(query, &arena);
  ASSERT_EQ(around.photons.size(), 49u);
  for (const NearPoint& near : around.photons) EXPECT_EQ(map.Alpha(near.index).r, 1);
}

TEST(PhotonMap, CountsPhotonsOfAFlattenedRegionOnly) {
  Arena arena;
  // One photon straight above at a height, one on the plane at the same distance.
  const std::vector<Photon> photons{{{0, 0, Real(.9)}, {0, 0, 1}, Spectrum(1)},
                                    {{Real(.9), 0, 0}, {0, 0, 1}, Spectrum(1)}};
  const PhotonMap map(Haul(photons, 1));
  const auto around = map.Find({{0, 0, 0}, {0, 0, 1}, 50, 1, true}, &arena);
  ASSERT_EQ(around.photons.size(), 1u);
  EXPECT_EQ(map.Position(around.photons[0].index).z, 0);
}

}  // namespace
}  // namespace exphoton
