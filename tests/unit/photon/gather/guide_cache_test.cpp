// SPDX-License-Identifier: BSD-2-Clause
// These tests check that the contents of a cache cell depend on the cell alone, and that a cell can
// be reprojected to any shading point within it.
#include "integrators/photon/gather/guide_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "integrators/photon/gather/reprojected_cell.h"

namespace exphoton {
namespace {

const Point3 kLamp(Real(.3), Real(.4), 1);
const Cone kCone(Radians(5));
constexpr Real kWidth = Real(.25);
constexpr int kCount = 40;
constexpr Real kFarthest = 20;

// Returns the neighbour count n = 2 e + sqrt(e) for which e is the largest expected count that is
// significantly exceeded. This inverts DenserThan.
Real Others(Real denserThan) { return 2 * denserThan + std::sqrt(denserThan); }

// Returns photons from the lamp on the square (0, 0)-(1, 1) of the plane z = 0.
PhotonMap LampMap(int count = 1000) {
  RandomStream random(3);
  PhotonBuffer buffer;
  buffer.farthest = kFarthest;
  for (int i = 0; i < count; ++i) {
    const Point3 p(random.Uniform(), random.Uniform(), 0);
    buffer.Add({p, Normalize(kLamp - p), Spectrum(1), Distance(p, kLamp) / kFarthest});
  }
  buffer.paths = 1;
  ThreadPool threads(1);
  return PhotonMap(std::move(buffer), threads);
}

std::vector<Real> Content(const GuideCell& cell) {
  std::vector<Real> content(cell.X(), cell.X() + 4 * cell.size());
  for (const Real x : {cell.Center().x, cell.Center().y, cell.Center().z}) content.push_back(x);
  return content;
}

TEST(GuideCache, SayTheSameWhicheverWasAskedBefore) {
  const PhotonMap map = LampMap();
  RandomStream random(11);
  std::vector<Point3> points;
  for (int i = 0; i < 3000; ++i)  // more cells than the cache can store
    points.emplace_back(2 * random.Uniform() - Real(.5), 2 * random.Uniform() - Real(.5),
                        2 * random.Uniform() - 1);
  GuideCache cells(GuideGrid(map, kCount, kCone, kWidth / 2));
  for (const Point3& p : points) {
    GuideCache fresh(GuideGrid(map, kCount, kCone, kWidth / 2));
    ASSERT_EQ(Content(cells.At(p)), Content(fresh.At(p)));
  }
}

TEST(GuideCache, AreSharedByThePointsInThem) {
  const PhotonMap map = LampMap();
  GuideCache cells(GuideGrid(map, kCount, kCone, kWidth));
  const GuideCell* const cell = &cells.At({Real(.51), Real(.51), Real(.01)});
  EXPECT_EQ(cell, &cells.At({Real(.74), Real(.74), Real(.2)}));
  EXPECT_NEAR(cell->Center().x, .625, 1e-6);
  EXPECT_NEAR(cell->Center().z, .125, 1e-6);
}

TEST(GuideCache, HoldFewerPhotonsWhereThereAreFewer) {
  const PhotonMap map = LampMap(7);
  GuideCache cells(GuideGrid(map, kCount, kCone, kWidth));
  EXPECT_EQ(cells.At({0, 0, 0}).size(), 7u);
  const PhotonMap none;
  EXPECT_EQ(GuideCache(GuideGrid(none, kCount, kCone, kWidth)).At({0, 0, 0}).size(), 0u);
}

TEST(GuideCache, CountAllOthersWhereLightComesFromOneDirection) {
  const PhotonMap map = LampMap();
  GuideCache cells(GuideGrid(map, kCount, Cone(Radians(45)), kWidth));
  const GuideCell& cell = cells.At({Real(.5), Real(.5), 0});
  for (std::size_t i = 0; i < cell.size(); ++i)
    EXPECT_NEAR(Others(cell.DenserThan()[i]), kCount - 1, 1e-3);
}

TEST(GuideCache, OfVeryManyPhotonsEstimateHowManyComeFromThere) {
  constexpr int kMany = 5000;
  const PhotonMap map = LampMap(kMany);
  GuideCache cells(GuideGrid(map, kMany, Cone(Radians(90)), 4));
  const GuideCell& cell = cells.At({Real(.5), Real(.5), Real(.1)});
  ASSERT_EQ(cell.size(), std::size_t(kMany));
  for (std::size_t i = 0; i < cell.size(); ++i)
    EXPECT_NEAR(Others(cell.DenserThan()[i]), kMany, 10);
}

// The photons arrived at other points of the cell, with directions up to 20 degrees away from the
// direction to the lamp.
TEST(ReprojectedCell, PointsToTheLampFromAnywhereInTheCell) {
  const PhotonMap map = LampMap();
  GuideCache cells(GuideGrid(map, kCount, kCone, kWidth));
  Arena arena;
  const LitSide up({0, 0, 1}, {0, 0, 1}, false);
  for (const Point3& p : {Point3(Real(.51), Real(.51), 0), Point3(Real(.74), Real(.6), 0)}) {
    const GuideCell& cell = cells.At(p);
    const ReprojectedCell view(cell, p, up, &arena);
    EXPECT_EQ(view.lit, kCount);
    const Vector3 lamp = Normalize(kLamp - p);
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const Vector3 w(view.x[i], view.y[i], view.z[i]);
      EXPECT_NEAR(Length(w), 1, 1e-6);
      EXPECT_GT(Dot(w, lamp), std::cos(Radians(Real(2.5))));
      EXPECT_NEAR(view.cosine[i], w.z, 1e-6);
    }
  }
}

TEST(ReprojectedCell, CountsLightFromBelowForSurfacesThatTransmitOnly) {
  const PhotonMap map = LampMap();
  GuideCache cells(GuideGrid(map, kCount, kCone, kWidth));
  Arena arena;
  const Point3 p(Real(.6), Real(.6), 0);
  const GuideCell& cell = cells.At(p);
  const ReprojectedCell below(cell, p, LitSide({0, 0, -1}, {0, 0, -1}, false), &arena);
  EXPECT_EQ(below.lit, 0);
  for (std::size_t i = 0; i < cell.size(); ++i) EXPECT_GT(below.cosine[i], ReprojectedCell::kUnlit);
  EXPECT_EQ(ReprojectedCell(cell, p, LitSide({0, 0, -1}, {0, 0, -1}, true), &arena).lit, kCount);
}

TEST(ReprojectedCell, IsTheSameWithEveryWidthOfVectors) {
  const PhotonMap map = LampMap();
  const Point3 p(Real(.6), Real(.7), 0);
  for (int count = 1; count < 40; ++count) {
    GuideCache cells(GuideGrid(map, count, kCone, kWidth));
    const GuideCell& cell = cells.At(p);
    Arena arena;
    const LitSide side(Normalize(Normal3(1, 0, Real(.3))), Normalize(Normal3(1, 1, 0)), false);
    ReprojectedCell first(cell, p, side, &arena), other(cell, p, side, &arena);
    ReprojectedCell::Kernels().front()(cell, p - cell.Center(), side, &first);
    for (const ReprojectedCell::Kernel look : ReprojectedCell::Kernels()) {
      look(cell, p - cell.Center(), side, &other);
      EXPECT_EQ(other.lit, first.lit);
      for (std::size_t i = 0; i < 4 * cell.size(); ++i) ASSERT_EQ(other.x[i], first.x[i]);
    }
  }
}

// The shading point is the photon's origin, so every unit direction is valid.
TEST(ReprojectedCell, HasUnitDirectionsFromWhereThePhotonsComeFrom) {
  PhotonBuffer buffer;
  buffer.Add({{0, 0, 0}, {0, 0, 1}, Spectrum(1), 0});
  buffer.paths = 1;
  ThreadPool threads(1);
  const PhotonMap map(std::move(buffer), threads);
  Arena scratch;
  const GuideCell cell(map, {0, 0, 0}, 1, kCone, &scratch);
  const Point3 origin = Point3() + Vector3(cell.X()[0], cell.Y()[0], cell.Z()[0]);
  const ReprojectedCell view(cell, origin, LitSide({0, 0, 1}, {0, 0, 1}, true), &scratch);
  EXPECT_NEAR(Length(Vector3(view.x[0], view.y[0], view.z[0])), 1, 1e-6);
}

}  // namespace
}  // namespace exphoton
