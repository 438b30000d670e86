// SPDX-License-Identifier: BSD-2-Clause
// These tests check that a table of guides returns the cells of its grid, whichever thread asked
// first, and that a full table says so.
#include "integrators/photon/gather/guide_table.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/base/parallel.h"
#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

const Cone kTableCone(Radians(5));
constexpr Real kTableWidth = Real(.1);
constexpr int kTableCount = 20, kPoints = 2000;

PhotonMap FloorMap() {
  RandomStream random(3);
  PhotonBuffer buffer;
  for (int i = 0; i < 500; ++i) {
    const Point3 p(random.Uniform(), random.Uniform(), 0);
    buffer.Add({p, Normalize(Vector3(random.Uniform(), random.Uniform(), 1)), Spectrum(1), 0});
  }
  buffer.paths = 1;
  ThreadPool threads(1);
  return PhotonMap(std::move(buffer), threads);
}

std::vector<Point3> Points(std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Point3> points;
  for (int i = 0; i < kPoints; ++i)
    points.emplace_back(random.Uniform(), random.Uniform(), Real(.3) * random.Uniform());
  return points;
}

std::vector<Real> TableContent(const GuideCell& cell) {
  std::vector<Real> content(cell.X(), cell.X() + 4 * cell.RowLength());
  for (const Real x : {cell.Center().x, cell.Center().y, cell.Center().z, cell.Radius2(),
                       cell.IrradiancePerPhoton()})
    content.push_back(x);
  return content;
}

TEST(GuideTable, ReturnsTheCellsOfItsGrid) {
  const PhotonMap map = FloorMap();
  const GuideGrid grid(map, kTableCount, kTableCone, kTableWidth);
  GuideTable table(grid);
  Arena arena;
  for (const Point3& p : Points(5)) {
    const GuideCell* cell = table.At(p, &arena);
    ASSERT_NE(cell, nullptr);
    ASSERT_EQ(TableContent(*cell), TableContent(grid.MakeCell(grid.KeyOf(p), &arena)));
    ASSERT_EQ(table.At(p, &arena), cell);  // it is kept
  }
  EXPECT_LE(table.CellCount(), 10u * 10 * 3);
  EXPECT_GT(table.CellCount(), 200u);
}

// In a table of 512 slots, many of the cells meet a slot of another cell.
TEST(GuideTable, TellsCellsInOneSlotApartByTheirKeys) {
  const PhotonMap map = FloorMap();
  const GuideGrid grid(map, kTableCount, kTableCone, kTableWidth);
  constexpr std::size_t kSlots = 512;
  GuideTable table(grid, std::size_t(1) << 28, kSlots);
  Arena arena;
  for (const Point3& p : Points(5)) {
    const GuideCell* cell = table.At(p, &arena);
    if (!cell) continue;  // half of the slots are used
    ASSERT_EQ(TableContent(*cell), TableContent(grid.MakeCell(grid.KeyOf(p), &arena)));
  }
  EXPECT_GT(table.CellCount(), kSlots * 2 / 5);
}

TEST(GuideTable, KeepsEachCellOnceForAllThreads) {
  const PhotonMap map = FloorMap();
  const GuideGrid grid(map, kTableCount, kTableCone, kTableWidth);
  GuideTable table(grid);
  const std::vector<Point3> points = Points(5);
  std::vector<std::vector<const GuideCell*>> found(4);
  std::vector<std::thread> threads;
  for (auto& cells : found) {
    threads.emplace_back([&] {
      Arena arena;
      for (const Point3& p : points) cells.push_back(table.At(p, &arena));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& cells : found) EXPECT_EQ(cells, found[0]);
}

TEST(GuideTable, ReturnsNoNewCellWhenItIsFull) {
  const PhotonMap map = FloorMap();
  GuideTable table(GuideGrid(map, kTableCount, kTableCone, kTableWidth), 1);
  Arena arena;
  const GuideCell* first = table.At({Real(.5), Real(.5), 0}, &arena);
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(table.At({Real(.05), Real(.05), 0}, &arena), nullptr);
  EXPECT_EQ(table.At({Real(.5), Real(.5), 0}, &arena), first);
  EXPECT_EQ(table.CellCount(), 1u);
}

TEST(GuideCell, KnowsTheIrradianceOfItsPhotons) {
  const PhotonMap map = FloorMap();  // 500 photons of power 1 on an area of 1
  Arena arena;
  const GuideCell cell(map, {Real(.5), Real(.5), 0}, 200, kTableCone, &arena);
  EXPECT_NEAR(double(cell.IrradiancePerPhoton()) * 200, 500, 50);
}

}  // namespace
}  // namespace exphoton
