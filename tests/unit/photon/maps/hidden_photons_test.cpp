// SPDX-License-Identifier: BSD-2-Clause
// These tests check which photons a wall hides from a point, on a floor with a wall without
// thickness.
#include "integrators/photon/maps/hidden_photons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string Mesh(const std::string& points) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + points + "]\n";
}

const std::string kFloor = Mesh("-4 -4 0  4 -4 0  4 4 0  -4 4 0");
const std::string kWall = Mesh("0 -4 0  0 4 0  0 4 3  0 -4 3");  // at x = 0

LoadedScene SceneOf(const std::string& world) {
  return LoadSceneText(TestHeader("\"path\"", 1, 1, 1) + "WorldBegin\n" + world + "WorldEnd\n");
}

// Places on the floor and on the wall, with the direction to a light above both of its sides.
const Vector3 kUp{0, 0, 1};
const Vector3 kRight = Normalize(Vector3{1, 0, 1}), kLeft = Normalize(Vector3{-1, 0, 1});

TEST(Walls, AreBetweenTheirSides) {
  const LoadedScene loaded = SceneOf(kFloor + kWall);
  const Walls walls(*loaded.setup->scene);
  ASSERT_TRUE(walls.Exist());
  const Walls::Place here{{Real(.2), 0, 0}, kUp};
  EXPECT_FALSE(walls.AreBetween(here, {{Real(.9), 0, 0}, kRight}));
  EXPECT_FALSE(walls.AreBetween(here, {{0, 0, Real(.1)}, kRight})) << "on this side of the wall";
  EXPECT_TRUE(walls.AreBetween(here, {{0, 0, Real(.1)}, kLeft})) << "on its other side";
  EXPECT_TRUE(walls.AreBetween(here, {{Real(-.1), 0, 0}, kLeft}));
  EXPECT_FALSE(walls.AreBetween(here, {here.p, kRight})) << "the same place";
}

TEST(Walls, AreNotOfGlass) {
  const LoadedScene loaded = SceneOf(kFloor + "Material \"glass\"\n" + kWall);
  const Walls walls(*loaded.setup->scene);
  EXPECT_FALSE(walls.AreBetween({{Real(.2), 0, 0}, kUp}, {{Real(-.1), 0, 0}, kLeft}));
}

TEST(Walls, SeeSurfacesInTheTangentPlane) {
  const LoadedScene loaded = SceneOf(kFloor + kWall);
  const Walls walls(*loaded.setup->scene);
  EXPECT_TRUE(walls.SurfaceContinues({{1, 0, 0}, kUp}, {-1, 0, 0}, 2));
  EXPECT_TRUE(walls.SurfaceContinues({{1, 0, 0}, kUp}, {1, 0, 0}, 2));
  EXPECT_FALSE(walls.SurfaceContinues({{3, 0, 0}, kUp}, {1, 0, 0}, 2)) << "beyond the edge";
}

TEST(Walls, DoNotExistWhereShapesMove) {
  const std::string moving =
      "AttributeBegin\nActiveTransform EndTime\nTranslate 1 0 0\nActiveTransform All\n"
      "Shape \"sphere\"\nAttributeEnd\n";
  EXPECT_FALSE(Walls(*SceneOf(kFloor + moving).setup->scene).Exist());
  EXPECT_FALSE(Walls().Exist());
}

// Photons in a row across the wall, on the floor and on both sides of the wall: 20 on the left, and
// up to 20 on the right.
struct Row {
  LoadedScene loaded;
  Walls walls;
  PhotonMap map;
  Arena arena;

  Row(const std::string& world, int right) : loaded(SceneOf(world)), walls(*loaded.setup->scene) {
    PhotonBuffer buffer;
    buffer.paths = 1;
    const auto add = [&](Real x, Real z, const Vector3& wi) {
      const PhotonRecord record({{x, 0, z}, wi, Spectrum(1)});
      buffer.photons.Append({&record, 1});
    };
    for (int i = 1; i <= 10; ++i) {
      const Real at = Real(i) / 10;
      add(-at, 0, kLeft);
      add(0, at / 3, kLeft);
      if (2 * i <= right) add(at, 0, kRight), add(0, at / 3, kRight);
    }
    ThreadPool threads(1);
    map = PhotonMap(std::move(buffer), threads);
  }

  PhotonQuery Query(Real x) const { return {{x, 0, 0}, Normal3(kUp), 100, 2, true}; }
  PhotonNeighbourhood Around(Real x) { return map.Find(Query(x), &arena); }
  SeenPhotons SeenFrom(Real x) { return WithoutHidden(map, Query(x), Around(x), walls, &arena); }
  PhotonNeighbourhood ProbablySeenFrom(Real x) {
    return ProbablySeen(map, Query(x), Around(x), walls, &arena);
  }
  bool IsBeside(Real x) { return IsBesideWall(map, Query(x), SeenFrom(x), walls); }
};

// Equally many photons are on both sides, as with small things, and none is lost.
TEST(HiddenPhotons, CountLikeSeenOnesUpToTheirNumber) {
  Row row(kFloor + kWall, 20);
  const SeenPhotons seen = row.SeenFrom(Real(.35));
  EXPECT_TRUE(seen.areSomeHidden);
  EXPECT_EQ(row.Around(Real(.35)).photons.size(), 40u);
  EXPECT_EQ(seen.around.photons.size(), 20u);
  EXPECT_EQ(seen.around.distance2.size(), 20u);
  EXPECT_EQ(seen.around.radius2, row.Around(Real(.35)).radius2);
  EXPECT_EQ(seen.around.share, Real(.5));
  for (const std::uint32_t photon : seen.around.photons) EXPECT_GT(row.map.Direction(photon).x, 0);
}

TEST(HiddenPhotons, CountNoMoreThanSeenOnes) {
  Row row(kFloor + kWall, 4);
  EXPECT_EQ(row.Around(Real(.15)).photons.size(), 24u);
  EXPECT_EQ(row.SeenFrom(Real(.15)).around.photons.size(), 4u);
  EXPECT_EQ(row.SeenFrom(Real(.15)).around.share, Real(.5)) << "4 of 8 photons, and not of 24";
}

TEST(HiddenPhotons, CountWithoutAWall) {
  Row row(kFloor, 20);
  EXPECT_EQ(row.SeenFrom(Real(.35)).around.photons.size(), 40u);
  EXPECT_EQ(row.SeenFrom(Real(.35)).around.share, 1);
  EXPECT_EQ(row.ProbablySeenFrom(Real(.35)).photons.size(), 40u);
}

TEST(HiddenPhotons, LeaveNothingOnADarkSide) {
  Row row(kFloor + kWall, 0);
  EXPECT_TRUE(row.SeenFrom(Real(.35)).areSomeHidden);
  EXPECT_EQ(row.SeenFrom(Real(.35)).around.photons.size(), 0u);
  EXPECT_EQ(row.ProbablySeenFrom(Real(.35)).photons.size(), 0u);
}

struct AtAnEdge {
  LoadedScene loaded;
  Walls walls;
  PhotonMap map;
  PhotonQuery query;
  Arena arena;
  PhotonNeighbourhood around;
  SeenPhotons seen;

  AtAnEdge(const std::string& world, const Point3& p, std::span<const Photon> photons)
      : loaded(SceneOf(world)),
        walls(*loaded.setup->scene),
        map(MapOf(photons)),
        query{p, {1, 0, 0}, 100, 2, true},
        around(map.Find(query, &arena)),
        seen(WithoutHidden(map, query, around, walls, &arena)) {}
  static PhotonMap MapOf(std::span<const Photon> photons) {
    ThreadPool threads(1);
    return PhotonMap(PhotonBuffer(photons, 1), threads);
  }
  PhotonNeighbourhood Probable() { return ProbablySeen(map, query, around, walls, &arena); }
};

// Photons on the top of a block count at its side, although the block lies between them. Another
// photon lies behind a screen before the block. It is hidden, so all photons are tested.
TEST(HiddenPhotons, CountRoundTheEdgeOfASolid) {
  std::vector<Photon> photons{{{Real(.3), 0, Real(-.5)}, kRight, Spectrum(1)}};
  for (int i = 1; i <= 9; ++i)
    photons.push_back({{Real(-.03) * Real(i), 0, 0}, kRight, Spectrum(1)});
  AtAnEdge edge(Mesh("-4 -4 0  0 -4 0  0 4 0  -4 4 0") + Mesh("0 -4 -4  0 4 -4  0 4 0  0 -4 0") +
                    Mesh(".25 -4 -4  .25 4 -4  .25 4 4  .25 -4 4"),
                {0, 0, Real(-.2)}, photons);
  ASSERT_EQ(edge.around.photons.size(), 10u);
  EXPECT_TRUE(edge.seen.areSomeHidden);
  ASSERT_EQ(edge.seen.around.photons.size(), 9u);
  for (const std::uint32_t photon : edge.seen.around.photons)
    EXPECT_LT(edge.map.Position(photon).x, 0);
  EXPECT_EQ(edge.Probable().photons.size(), 10u);
}

// The roof goes on over the top of the wall to its other side, and a photon lies on it there.
TEST(HiddenPhotons, AreThoseOnARoofBehindThePlaneOfItsWall) {
  const std::string wall = Mesh("0 -4 -4  0 4 -4  0 4 0  0 -4 0");
  const Photon photon{{Real(-.05), 0, 0}, kRight, Spectrum(1)};
  AtAnEdge roofed(wall + Mesh("-1 -4 0  4 -4 0  4 4 0  -1 4 0"), {0, 0, Real(-.1)}, {&photon, 1});
  ASSERT_EQ(roofed.around.photons.size(), 1u);
  EXPECT_TRUE(roofed.seen.areSomeHidden);
  EXPECT_EQ(roofed.seen.around.photons.size(), 0u);
  EXPECT_EQ(roofed.Probable().photons.size(), 0u);
  EXPECT_TRUE(IsBesideWall(roofed.map, roofed.query, roofed.seen, roofed.walls));
  AtAnEdge block(wall + Mesh("-1 -4 0  0 -4 0  0 4 0  -1 4 0"), {0, 0, Real(-.1)}, {&photon, 1});
  EXPECT_FALSE(block.seen.areSomeHidden);
  EXPECT_EQ(block.Probable().photons.size(), 1u);
}

// From the lit side of the wall nothing is hidden, but the floor goes on behind the wall, so points
// there must not read what is computed here.
TEST(HiddenPhotons, ShowThatTheFloorGoesOnBehindAWall) {
  Row row(kFloor + kWall, 0);
  EXPECT_TRUE(row.IsBeside(Real(-.35)));
  EXPECT_FALSE(row.SeenFrom(Real(-.35)).areSomeHidden);
  Row corner(Mesh("-4 -4 0  0 -4 0  0 4 0  -4 4 0") + kWall, 0);  // the floor ends at the wall
  EXPECT_FALSE(corner.IsBeside(Real(-.35)));
}

// Half of each layer is hidden, so an eighth of the points leave the photons out.
TEST(HiddenPhotons, AreLeftOutAtSomeOfManyPoints) {
  Row row(kFloor + kWall, 20);
  int all = 0, points = 0;
  for (Real x = Real(.2); x < Real(.4); x += Real(.0005), ++points) {
    const std::size_t size = row.ProbablySeenFrom(x).photons.size();
    EXPECT_TRUE(size == 40 || size == 0) << size;
    all += size == 40 ? 1 : 0;
  }
  EXPECT_NEAR(double(all) / points, .875, .055);  // 400 points: a standard error of .017
}

// A sheet that transmits sees photons of both sides. Its back has a tangent plane with
// the opposite normal, also where the sheet bends towards the viewer.
TEST(HiddenPhotons, AreNotThoseAtTheBackOfABowl) {
  const LoadedScene loaded =
      SceneOf("Material \"translucent\"\nShape \"sphere\" \"float radius\" 1 \"float zmax\" 0\n");
  PhotonBuffer buffer;
  buffer.paths = 1;
  for (int i = 1; i <= 10; ++i) {
    const Real angle = Real(i) / 10, s = std::sin(angle), c = std::cos(angle);
    const PhotonRecord record({{s, 0, -c}, Vector3{s, 0, -c}, Spectrum(1)});
    buffer.photons.Append({&record, 1});
  }
  ThreadPool threads(1);
  const PhotonMap map(std::move(buffer), threads);
  Arena arena;
  const PhotonQuery query{{0, 0, -1}, Normal3(kUp), 100, 2, false};
  const PhotonNeighbourhood around = map.Find(query, &arena);
  ASSERT_EQ(around.photons.size(), 10u);
  const Walls walls(*loaded.setup->scene);
  EXPECT_EQ(WithoutHidden(map, query, around, walls, &arena).around.photons.size(), 10u);
  EXPECT_EQ(ProbablySeen(map, query, around, walls, &arena).photons.size(), 10u);
}

}  // namespace
}  // namespace exphoton
