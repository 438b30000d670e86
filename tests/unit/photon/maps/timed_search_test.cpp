// SPDX-License-Identifier: BSD-2-Clause
// These tests check estimates at a time of the exposure: which photons count, and that the light is
// the light of that time.
#include "integrators/photon/maps/timed_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/sampling/random.h"

namespace exphoton {
namespace {

constexpr int kPhotons = 20000;  // on a square of 2 x 2

// Returns photons whose times are Time(u) of the exposure, for uniform u in [0,1).
template <class Time>
PhotonMap MapWith(const Interval& exposure, const Time& time) {
  RandomStream random(1);
  PhotonBuffer buffer;
  buffer.paths = 1;
  buffer.times = exposure;
  for (int i = 0; i < kPhotons; ++i) {
    const Point3 p{2 * random.Uniform() - 1, 2 * random.Uniform() - 1, 0};
    const PhotonRecord record({p, {0, 0, 1}, Spectrum(1)},
                              EncodePhotonTime(time(random.Uniform())));
    buffer.photons.Append({&record, 1});
  }
  ThreadPool threads(1);
  return PhotonMap(std::move(buffer), threads);
}

const PhotonQuery kQuery{{0, 0, 0}, {0, 0, 1}, 50, 1, true};

// Returns the density of light at a time, relative to its mean over the exposure.
double LightAt(Real time, const PhotonMap& map) {
  Arena arena;
  const PhotonNeighbourhood around = FindAt(time, map, kQuery, kInfinity, &arena);
  const double area = double(kPi * around.radius2);
  return double(around.photons.size()) / (area * double(around.share)) / (kPhotons / 4.);
}

TEST(TimedSearch, CountsAllPhotonsOfEvenLight) {
  const PhotonMap map = MapWith({0, 1}, [](Real u) { return u; });
  Arena arena;
  const PhotonNeighbourhood all = map.Find(kQuery, &arena);
  for (const Real time : {Real(0), Real(.3), Real(1)}) {
    const PhotonNeighbourhood found = FindAt(time, map, kQuery, kInfinity, &arena);
    EXPECT_EQ(found.share, 1);
    EXPECT_EQ(found.radius2, all.radius2);
    EXPECT_EQ(found.photons.size(), all.photons.size());
  }
}

TEST(TimedSearch, SeesLightWhenItIsThere) {
  const PhotonMap map = MapWith({0, 1}, [](Real u) { return u / 2; });
  for (const Real time : {Real(0), Real(.1), Real(.25), Real(.4)})
    EXPECT_NEAR(LightAt(time, map), 2, .5) << time;  // 100 of 400 photons: a standard error of .2
  for (const Real time : {Real(.6), Real(.8), Real(1)}) EXPECT_EQ(LightAt(time, map), 0) << time;
}

TEST(TimedSearch, KnowsTheExposure) {
  const PhotonMap map = MapWith({3, 5}, [](Real u) { return Real(.75) + u / 4; });
  EXPECT_EQ(LightAt(3, map), 0);
  EXPECT_EQ(LightAt(4, map), 0);
  EXPECT_NEAR(LightAt(Real(4.8), map), 4, .8);
  EXPECT_NEAR(LightAt(5, map), 4, .8);
}

// The window is an eighth of the exposure, so the light at the end of a short flash is too dark.
TEST(TimedSearch, BlursAShortFlashOverAnEighthOfTheExposure) {
  const PhotonMap map = MapWith({0, 1}, [](Real u) { return Real(.5) + u / 64; });
  EXPECT_NEAR(LightAt(Real(.51), map), 8, 1.6);
  EXPECT_EQ(LightAt(Real(.4), map), 0);
}

TEST(TimedSearch, WithoutTimesFindsWhatTheMapFinds) {
  const PhotonMap map = MapWith({0, 0}, [](Real u) { return u / 2; });
  EXPECT_FALSE(map.HasTimes());
  Arena arena;
  EXPECT_EQ(FindAt(1, map, kQuery, kInfinity, &arena).photons.size(),
            map.Find(kQuery, &arena).photons.size());
}

// The wider disk of a dim point takes in more of its brighter surroundings, so few photons would be
// biased by windows.
TEST(TimedSearch, OfFewPhotonsHasFewerWindows) {
  Arena arena;
  for (const auto& [k, exposure] : {std::pair(50, .125), {400, 1. / 3}, {600, .5}, {900, 1.}}) {
    PhotonQuery query = kQuery;
    query.k = k;
    const PhotonMap map = MapWith({0, 1}, [](Real u) { return u / 2; });
    EXPECT_FLOAT_EQ(float(FindAt(Real(.25), map, query, kInfinity, &arena).share), float(exposure))
        << k;
  }
}

TEST(TimedSearch, NeverExceedsAGivenRadius) {
  const PhotonMap map = MapWith({0, 1}, [](Real u) { return u / 2; });
  PhotonQuery query = kQuery;
  query.maxDistance = Real(.05);  // 39 photons
  Arena arena;
  EXPECT_FLOAT_EQ(float(FindAt(Real(.25), map, query, 1, &arena).radius2), .0025f);
  EXPECT_GT(FindAt(Real(.25), map, query, kInfinity, &arena).radius2, .01);
}

// Codes of times are (c + .5) / 256, and windows may begin and end at codes. The 127 nearest
// photons have codes 0 to 126.
TEST(TimedSearch, HasAsManyCodesInAllWindows) {
  PhotonBuffer buffer;
  buffer.paths = 1, buffer.times = {0, 1};
  for (int i = 0; i < 4096; ++i) {
    const Real radius = Real(.01) * std::sqrt(Real(i + 1)), angle = Real(2.4 * i);
    const Point3 p{radius * std::cos(angle), radius * std::sin(angle), 0};
    const PhotonRecord record({p, {0, 0, 1}, Spectrum(1)}, std::uint8_t(i % 128));
    buffer.photons.Append({&record, 1});
  }
  ThreadPool threads(1);
  const PhotonMap map(std::move(buffer), threads);
  PhotonQuery query = kQuery;
  query.k = 16;
  Arena arena;
  for (const Real time : {Real(.25), Real(64.5) / 256, Real(40.5) / 256, Real(.3)})
    EXPECT_EQ(FindAt(time, map, query, kInfinity, &arena).photons.size(), 32u) << time;
}

// Such photons lie along their directions at the farthest distance, because theirs is not known.
TEST(TimedSearch, OriginsOfPhotonsWithTimesAreFarAway) {
  PhotonBuffer buffer;
  buffer.paths = 1, buffer.times = {0, 1}, buffer.farthest = 10;
  const PhotonRecord record({{1, 2, 3}, {0, 0, 1}, Spectrum(1)}, EncodePhotonTime(Real(.5)));
  buffer.photons.Append({&record, 1});
  ThreadPool threads(1);
  const PhotonMap map(std::move(buffer), threads);
  EXPECT_NEAR(double(map.Origin(0).z), 13, 1e-2);
}

}  // namespace
}  // namespace exphoton
