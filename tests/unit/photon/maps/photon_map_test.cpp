// SPDX-License-Identifier: BSD-2-Clause
// These tests check the searches of the photon map: the photons that count, and the
// radius of a search.
#include "integrators/photon/maps/photon_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

PhotonMap MapOf(const std::vector<Photon>& photons, std::int64_t paths) {
  ThreadPool threads(1);
  return PhotonMap(PhotonBuffer(photons, paths), threads);
}

TEST(PhotonMap, WithoutPhotonsAnswersZero) {
  Arena arena;
  const PhotonMap map;
  const auto e = map.EstimateIrradiance({{0, 0, 0}, {0, 0, 1}, 50, 1, true}, &arena);
  EXPECT_TRUE(e.e.IsBlack());
  EXPECT_EQ(map.Nearest({0, 0, 0}, 50, &arena).size(), 0u);
  EXPECT_EQ(map.TypicalRadius(50, &arena), 0);
}

// A photon at height h over the plane counts as if it were h / kFlatness away.
TEST(PhotonMap, LooksLessFarAlongTheNormalThanAcross) {
  const auto found = [](Real height, Real across) {
    Arena arena;
    const PhotonMap map = MapOf({{{across, 0, height}, {0, 0, 1}, Spectrum(1)}}, 1);
    return map.Find({{0, 0, 0}, {0, 0, 1}, 50, 1, true}, &arena).photons.size();
  };
  const Real limit = PhotonMap::kFlatness;
  EXPECT_EQ(found(0, Real(.99)), 1u);
  EXPECT_EQ(found(Real(.98) * limit, 0), 1u);
  EXPECT_EQ(found(Real(1.02) * limit, 0), 0u);
  EXPECT_EQ(found(Real(-1.02) * limit, 0), 0u);
}

// Each photon has four neighbours at distance 1 and four on the diagonals. It does not
// count itself.
TEST(PhotonMap, OnAUnitLatticeHasTheRadiusOfItsNeighbours) {
  std::vector<Photon> photons;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) photons.push_back({{Real(x), Real(y), 0}, {0, 0, 1}, Spectrum(1)});
  Arena arena;
  const PhotonMap map = MapOf(photons, 1);
  EXPECT_EQ(map.TypicalRadius(4, &arena), 1);
  EXPECT_FLOAT_EQ(float(map.TypicalRadius(5, &arena)), std::sqrt(2.f));
  EXPECT_FLOAT_EQ(float(map.TypicalRadius(8, &arena)), std::sqrt(2.f));
  EXPECT_EQ(map.TypicalRadius(9, &arena), 2);
}

TEST(PhotonMap, OfCoincidentPhotonsStaysFinite) {
  Arena arena;
  std::vector<Photon> photons(100, Photon{{1, 2, 3}, {0, 0, 1}, Spectrum(1)});
  const PhotonMap map = MapOf(photons, 10);
  const auto e = map.EstimateIrradiance({{1, 2, 3}, {0, 0, 1}, 50, 1, true}, &arena);
  EXPECT_TRUE(e.own.IsFinite());
  EXPECT_GT(e.own.r, 0);
  // Four rounding errors of the largest coordinate.
  EXPECT_NEAR(double(e.radius / (12 * kMachineEpsilon)), 1, 1e-4);
  EXPECT_NEAR(double(map.TypicalRadius(10, &arena) / (12 * kMachineEpsilon)), 1, 1e-4);
}

TEST(PhotonMap, IgnoresPhotonsThatArrivedOnTheOtherSide) {
  Arena arena;
  std::vector<Photon> photons;
  RandomStream random(17);
  for (int i = 0; i < 400; ++i) {
    const Point3 p{random.Uniform(), random.Uniform(), 0};
    photons.push_back({p, {0, 0, i % 2 ? Real(1) : Real(-1)}, i % 2 ? Spectrum(1) : Spectrum(100)});
  }
  const PhotonMap map = MapOf(photons, 200);
  const PhotonQuery query{{Real(.5), Real(.5), 0}, {0, 0, 1}, 50, Real(.4), true};
  const auto around = map.Find(query, &arena);
  ASSERT_EQ(around.photons.size(), 49u);
  for (const std::uint32_t i : around.photons) EXPECT_EQ(map.Alpha(i).r, 1);
}

TEST(PhotonMap, CountsPhotonsOfAFlattenedRegionOnly) {
  Arena arena;
  // One photon is straight above the point, and one is on the plane at the same distance.
  const std::vector<Photon> photons{{{0, 0, Real(.9)}, {0, 0, 1}, Spectrum(1)},
                                    {{Real(.9), 0, 0}, {0, 0, 1}, Spectrum(1)}};
  const PhotonMap map = MapOf(photons, 1);
  const auto around = map.Find({{0, 0, 0}, {0, 0, 1}, 50, 1, true}, &arena);
  ASSERT_EQ(around.photons.size(), 1u);
  EXPECT_EQ(map.Position(around.photons[0]).z, 0);
}

TEST(PhotonMap, HoldsPowersAsTheyAreAndDirectionsToAThousandthOfARadian) {
  RandomStream random(19);
  std::vector<Photon> photons;
  for (int i = 0; i < 1000; ++i) {
    const auto u = [&] { return 2 * random.Uniform() - 1; };
    photons.push_back({{Real(i), 0, 0},
                       NormalizeOr({u(), u(), u()}, {0, 0, 1}),
                       {std::abs(u()), std::abs(u()), std::abs(u())}});
    photons.back().hasNegativeSign = i % 3 == 0;
  }
  photons[3].alpha.r = 0;
  const PhotonMap map = MapOf(photons, 1);
  ASSERT_EQ(map.Size(), photons.size());
  for (std::uint32_t i = 0; i < map.Size(); ++i) {
    const Photon& photon = photons[std::size_t(map.Position(i).x)];
    EXPECT_EQ(map.Alpha(i), photon.alpha);
    EXPECT_EQ(map.Sign(i), photon.hasNegativeSign ? -1 : 1);
    EXPECT_LT(Distance(map.Direction(i), photon.wi), 1.2e-3);
  }
}

TEST(PhotonMap, TakesAtMost32BytesAPhoton) {
  if (sizeof(Real) != 4) GTEST_SKIP();
  RandomStream random(29);
  std::vector<Photon> photons;
  for (int i = 0; i < 20000; ++i)
    photons.push_back({{random.Uniform(), random.Uniform(), 0}, {0, 0, 1}, Spectrum(1)});
  const PhotonMap map = MapOf(photons, 1);
  EXPECT_LE(double(map.MemoryBytes()), 32 * 20000);
  EXPECT_NEAR(double(map.MemoryBytes()), PhotonMap::kBytesPerPhoton * 20000, 20000);
}

}  // namespace
}  // namespace exphoton
