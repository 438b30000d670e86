// SPDX-License-Identifier: BSD-2-Clause
// These tests scatter photons over a plane, and compare estimates of irradiance with their density.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/sampling/random.h"
#include "integrators/photon/maps/own_photon_weight.h"
#include "integrators/photon/maps/photon_map.h"

namespace exphoton {
namespace {

constexpr int kNearest = 50;

// Returns photons on the part of a unit square where x is below `edge`, with the density 10000.
PhotonMap PlanePhotons(std::uint64_t seed, Real edge) {
  RandomStream random(seed);
  std::vector<Photon> photons;
  for (int i = 0; i < 10000; ++i) {
    const Point3 p{random.Uniform(), random.Uniform(), 0};
    if (p.x < edge) photons.push_back({p, {0, 0, 1}, Spectrum(1)});
  }
  ThreadPool threads(1);
  return PhotonMap(PhotonBuffer(photons, 10000), threads);
}

PhotonMap::Irradiance EstimateAt(const PhotonMap& map, const Point3& p, Real farthest = Real(.2)) {
  Arena arena;
  return map.EstimateIrradiance({p, {0, 0, 1}, kNearest, farthest, true}, &arena);
}

double IrradianceAt(const PhotonMap& map, const Point3& p) {
  return double(EstimateAt(map, p).e.g);
}

// The radius of k photons, and of the own disk of one.
const double kRadius = std::sqrt(kNearest / 10000. / std::numbers::pi);
const double kDiskRadius = std::sqrt(PhotonMap::kOwnDisk) * kRadius;

TEST(PhotonDisks, GiveTheDensityOfAPlane) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const PhotonMap map = PlanePhotons(seed, 1);
    RandomStream random(100 + seed);
    for (int i = 0; i < 1000; ++i, ++count)
      sum += IrradianceAt(
          map, {Real(.1) + Real(.8) * random.Uniform(), Real(.1) + Real(.8) * random.Uniform(), 0});
  }
  EXPECT_NEAR(sum / count, 1, .004);
}

// A dark point finds k photons beyond the edge, but their disks do not reach it.
TEST(PhotonDisks, DoNotReachFarIntoTheDark) {
  constexpr double kStep = .05;  // in units of the own disk
  double lost = 0, gained = 0, beyond = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const PhotonMap map = PlanePhotons(seed, Real(.5));
    for (Real y = Real(.2); y < Real(.8); y += Real(.06), ++count) {
      for (double d = kStep / 2; d < 5; d += kStep) {
        const Real x = Real(d * kDiskRadius);
        if (d < 2) lost += 1 - IrradianceAt(map, {Real(.5) - x, y, 0});
        const double dark = IrradianceAt(map, {Real(.5) + x, y, 0});
        gained += dark;
        if (d > 1.5) beyond += dark;
      }
    }
  }
  // Disks of one size would lose and gain 2 / (3 pi) of their radius. At the edge they are larger.
  EXPECT_NEAR(lost / count * kStep, .25, .05);
  EXPECT_NEAR(gained / count * kStep, lost / count * kStep, .03);
  EXPECT_LT(beyond, .05 * gained);
}

// Near a bright half of the plane, most of the nearest photons are bright ones whose disks do not
// reach the point. Dim photons have large disks that do, and the search finds few of them.
TEST(PhotonDisks, KeepDimLightBesideBrightLight) {
  constexpr Real kDim = Real(.01);  // of the density of bright photons
  constexpr int kPhotons = 100000;
  const double dimRadius =
      std::sqrt(PhotonMap::kOwnDisk * kNearest / (double(kDim) * kPhotons * std::numbers::pi));
  double sum = 0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    RandomStream random(seed);
    std::vector<Photon> photons;
    for (int i = 0; i < kPhotons; ++i) {
      const Point3 p{random.Uniform(), random.Uniform(), 0};
      if (p.x < Real(.5) || random.Uniform() < kDim) photons.push_back({p, {0, 0, 1}, Spectrum(1)});
    }
    ThreadPool threads(1);
    const PhotonMap map(PhotonBuffer(photons, kPhotons), threads);
    for (Real y = Real(.2); y < Real(.8); y += Real(.02), ++count)
      sum += IrradianceAt(map, {Real(.5 + .4 * dimRadius), y, 0});
  }
  EXPECT_NEAR(sum / count / double(kDim), 1, .25);
}

TEST(PhotonDisks, OfFewPhotonsHaveTheLargestRadius) {
  std::vector<Photon> photons;
  for (const Real x : {Real(0), Real(1), Real(9)})
    photons.push_back({{x, 0, 0}, {0, 0, 1}, Spectrum(1)});
  Arena arena;
  ThreadPool threads(1);
  const PhotonMap map(PhotonBuffer(photons, 1), threads);
  const auto at = [&](Real x) {
    return map.EstimateIrradiance({{x, 0, 0}, {0, 0, 1}, kNearest, 2, true}, &arena);
  };
  EXPECT_NEAR(double(at(Real(.5)).e.g * kPi * 4), 2, 1e-5);
  EXPECT_NEAR(double(at(Real(2.5)).e.g * kPi * 4), 1, 1e-5);
  EXPECT_NEAR(double(at(9).own.g * kPi * 4), 1, 1e-5);
  EXPECT_EQ(at(9).radius, 2);
  const PhotonMap single(PhotonBuffer(std::vector<Photon>{photons.front()}, 1), threads);
  const auto e = single.EstimateIrradiance({{0, 0, 0}, {0, 0, 1}, kNearest, 2, true}, &arena);
  EXPECT_NEAR(double(e.own.g * kPi * 4), 1, 1e-5);
}

// Points read the nearest of the radiance photons, which a share of the photons have. Points that
// find none use the disk of k photons about them.
struct ReadingPoints {
  double share = .125;
  double farthest = .2;  // radius of the largest disk
  int seeds = 40;

  double MeanIrradiance() const {
    const OwnPhotonWeight weight(share, 1);
    double sum = 0;
    int count = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const PhotonMap map = PlanePhotons(std::uint64_t(seed), 1);
      RandomStream random(100 + std::uint64_t(seed));
      const PhotonMap sites = RadiancePhotons(map, &random);
      for (int i = 0; i < 1000; ++i, ++count)
        sum += ReadAt(
            map, sites, weight,
            {Real(.15) + Real(.7) * random.Uniform(), Real(.15) + Real(.7) * random.Uniform(), 0});
    }
    return sum / count;
  }

 private:
  PhotonMap RadiancePhotons(const PhotonMap& map, RandomStream* random) const {
    std::vector<Photon> chosen;
    for (std::uint32_t i = 0; i < map.Size(); ++i)
      if (double(random->Uniform()) < share)
        chosen.push_back({map.Position(i), {0, 0, 1}, Spectrum(1)});
    ThreadPool threads(1);
    return PhotonMap(PhotonBuffer(chosen, 1), threads);
  }

  double ReadAt(const PhotonMap& map, const PhotonMap& sites, const OwnPhotonWeight& weight,
                const Point3& p) const {
    Arena arena;
    const Point3 site = sites.Position(sites.Nearest(p, 1, &arena).index[0]);
    const PhotonMap::Irradiance found = EstimateAt(map, site, Real(farthest));
    if (double(Length(site - p)) <= double(found.radius))
      return double(found.e.g) +
             double(found.own.g) *
                 weight.In(found.density * found.ownDisk2,
                           found.density * double(found.radius) * double(found.radius));
    const PhotonNeighbourhood around =
        map.Find({p, {0, 0, 1}, kNearest, Real(farthest), true}, &arena);
    return double(around.photons.size()) / (10000 * std::numbers::pi * double(around.radius2));
  }
};

TEST(PhotonDisks, HaveTheTrueMeanAtTheNearestRadiancePhoton) {
  EXPECT_NEAR(ReadingPoints().MeanIrradiance(), 1, .004);
}

// Disks of 2 photons of constant size hold few radiance photons, and most points find none.
TEST(PhotonDisks, HaveTheTrueMeanWhereMostPointsFindNoRadiancePhoton) {
  const double radius = std::sqrt(2 / 10000. / std::numbers::pi);
  EXPECT_NEAR((ReadingPoints{.125, radius, 80}.MeanIrradiance()), 1, .01);
}

// The circle about a point that ends at the nearest radiance photon is wholly in a large disk, and
// holds one radiance photon in the mean. Half of a small disk lies in it.
TEST(OwnPhotonWeight, FollowsTheSizeOfTheDisk) {
  EXPECT_NEAR(OwnPhotonWeight(1, 1).In(1000, 1000), 1, .01);
  const OwnPhotonWeight weight(.125, 1);
  for (const double inDisk : {.3, .01, 1e-6})
    EXPECT_NEAR(weight.In(inDisk, 100) / inDisk, .061, .004) << inDisk;
  EXPECT_NEAR(weight.In(30, 50), .728, .005);
  EXPECT_NEAR(weight.In(50, 50), .877, .005);
  EXPECT_EQ(OwnPhotonWeight().In(3, 5), 1);
  double last = 0;
  for (double inDisk = 0; inDisk < 200; inDisk += 1) {
    EXPECT_GE(weight.In(inDisk, 50), last - .001);
    last = weight.In(inDisk, 50);
  }
}

// Where nearly no point finds a radiance photon, those that do must make up for all others.
TEST(OwnPhotonWeight, IsOneInADiskWithoutOthers) {
  const OwnPhotonWeight weight(.125, 1);
  for (const double inReach : {0., 1e-9, .001, .1})
    EXPECT_NEAR(weight.In(inReach, inReach), 1, .01);
  EXPECT_NEAR(weight.In(.06, .1), .6, .01);
}

}  // namespace
}  // namespace exphoton
