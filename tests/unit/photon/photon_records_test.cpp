// SPDX-License-Identifier: BSD-2-Clause
// These tests check what photons hold where it follows from the scene: power after each bounce,
// distance since the last scattering, the sites of radiance photons, and the number of paths.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/math/octahedral.h"
#include "core/scattering/lobes/microfacet.h"
#include "core/scene/scene.h"
#include "integrators/photon/maps/photon_distance.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

struct Shot {
  Point3 p;
  double distance;  // scene units
  Vector3 wi;
  Spectrum power;
};

std::vector<Shot> ShotsOf(PhotonPassResult* result, PhotonKind kind) {
  std::vector<Shot> shots;
  PhotonBuffer& buffer = (*result)[kind];
  for (std::size_t i = 0; i < buffer.photons.Size(); ++i) {
    const PhotonRecord& photon = buffer.photons.Records()[i];
    shots.push_back({photon.p,
                     double(DecodeDistance(OctahedralPayload(photon.direction)) * buffer.farthest),
                     DecodeOctahedral(photon.direction), photon.power.Power()});
  }
  return shots;
}

PhotonPassResult Shoot(const std::string& world, const PhotonTargets& targets,
                       const PhotonSettings& settings = {}) {
  const LoadedScene loaded = LoadSceneText("WorldBegin\n" + world + "WorldEnd\n");
  return ShootPhotons(*loaded.setup->scene, 1, targets, settings);
}

const std::string kRecordLamp =
    "LightSource \"point\" \"color I\" [3 2 1] \"point from\" [0 0 2]\n";
const std::string kRecordFloor = "Shape \"disk\" \"float radius\" 9\n";

// The distance of a photon is the length of its path since the light, also over mirrors.
TEST(PhotonRecords, HaveTheLengthOfThePathFromTheLight) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Caustic] = 1000;
  PhotonPassResult result =
      Shoot(kRecordLamp + kRecordFloor +
                "Material \"mirror\" Translate 0 0 4 ReverseOrientation Shape \"disk\" \"float "
                "radius\" 9\n",
            targets);
  // A distance is stored relative to eight radii of the sphere round the scene's box.
  const double radius = std::sqrt(9. * 9 + 9 * 9 + 2 * 2);
  EXPECT_NEAR(double(result.buffers[0].farthest), 8 * radius, 1e-3);
  const auto direct = ShotsOf(&result, PhotonKind::Direct);
  ASSERT_GE(direct.size(), 1000u);
  for (const Shot& photon : direct) {
    const double length = double(Distance(photon.p, Point3(0, 0, 2)));
    EXPECT_NEAR(photon.distance / length, 1, .05);
    EXPECT_NEAR(double(Length(photon.p + photon.wi * Real(length) - Point3(0, 0, 2))), 0,
                3e-3 * length);
  }
  const auto caustic = ShotsOf(&result, PhotonKind::Caustic);
  ASSERT_GE(caustic.size(), 1000u);
  for (const Shot& photon : caustic) {
    // Over an odd number of mirrors: the lamp's image in the mirror at z = 4 is at z = 6.
    const double length = double(Distance(photon.p, Point3(0, 0, 6)));
    EXPECT_NEAR(photon.distance / length, 1, .05);
  }
}

// After a diffuse bounce it is the distance from there.
TEST(PhotonRecords, HaveTheLengthSinceTheLastDiffuseBounce) {
  PhotonTargets targets;
  targets[PhotonKind::Indirect] = 2000;
  PhotonSettings settings;
  settings.maxPhotonDepth = 2;
  // The lamp lights only the small plate, and all further photons come from it.
  PhotonPassResult result = Shoot(
      "LightSource \"spot\" \"point from\" [0 0 2] \"point to\" [0 0 3] \"float coneangle\" 5 "
      "\"float conedeltaangle\" 0\nMaterial \"matte\" \"color Kd\" [1 1 1]\n" +
          kRecordFloor + "Translate 0 0 3 ReverseOrientation Shape \"disk\" \"float radius\" .1\n",
      targets, settings);
  const auto shots = ShotsOf(&result, PhotonKind::Indirect);
  ASSERT_GE(shots.size(), 2000u);
  for (const Shot& photon : shots) {
    const double length = double(Distance(photon.p, Point3(0, 0, 3)));
    EXPECT_NEAR(photon.distance / length, 1, .1);
  }
}

const std::string kRecordSphere = "ReverseOrientation Shape \"sphere\" \"float radius\" 5\n";

// All photons of one lamp leave it with its whole power, 4 pi I.
Spectrum Emitted() { return Spectrum(3, 2, 1) * (4 * kPi); }

void ExpectRelative(const Spectrum& a, const Spectrum& b) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(double(a[c] / b[c]), 1, 1e-4);
}

TEST(PhotonRecords, KeepLuminanceOrLargestChannelByRoulette) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 500;
  for (const PhotonRoulette roulette : {PhotonRoulette::Luminance, PhotonRoulette::MaxComponent}) {
    PhotonSettings settings;
    settings.photonRoulette = roulette;
    PhotonPassResult result =
        Shoot(kRecordLamp + "Material \"matte\" \"color Kd\" [.2 .6 .8]\n" + kRecordSphere, targets,
              settings);
    for (const Shot& photon : ShotsOf(&result, PhotonKind::Direct))
      ExpectRelative(photon.power, Emitted());
    int colored = 0;
    for (const Shot& photon : ShotsOf(&result, PhotonKind::Indirect)) {
      if (roulette == PhotonRoulette::Luminance) {
        EXPECT_NEAR(double(photon.power.Y() / Emitted().Y()), 1, 1e-4);
      } else {
        EXPECT_NEAR(double(photon.power.MaxComponent() / Emitted().MaxComponent()), 1, 1e-4);
      }
      colored += photon.power.r < photon.power.g;
    }
    EXPECT_GT(colored, 300);
  }
}

// Up to the third bounce photons lose what is absorbed. From the fourth on, half of them survive
// with twice the power.
TEST(PhotonRecords, LosePowerForThreeBouncesAndHalfOfThemAfterwards) {
  PhotonTargets targets;
  targets[PhotonKind::Indirect] = 3000;
  PhotonPassResult result = Shoot(
      kRecordLamp + "Material \"matte\" \"color Kd\" [.25 .25 .25]\n" + kRecordSphere, targets);
  std::vector<int> counts(12, 0);
  for (const Shot& photon : ShotsOf(&result, PhotonKind::Indirect)) {
    const double lost = double(photon.power.g / Emitted().g);
    // 1/4 for each of three bounces, then 1/2.
    const double bounces = lost > std::pow(.25, 3.5) ? std::log(lost) / std::log(.25)
                                                     : 3 + std::log(lost * 64) / std::log(.5);
    const auto whole = std::lround(bounces);
    EXPECT_NEAR(bounces, double(whole), 1e-3);
    if (whole < 12) ++counts[std::size_t(whole)];
  }
  EXPECT_EQ(counts[0], 0);
  EXPECT_EQ(counts[1], counts[2]);
  EXPECT_EQ(counts[2], counts[3]);
  EXPECT_NEAR(double(counts[4]) / counts[3], .5, .08);
  EXPECT_NEAR(double(counts[5]) / counts[4], .5, .1);
}

// Two lamps of different power: their photons carry power over the probability of the choice.
TEST(PhotonRecords, CarryThePowerOverTheProbabilityOfTheirLight) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = 2000;
  const std::string lamps =
      "LightSource \"point\" \"color I\" [1 1 1]\nLightSource \"point\" \"color I\" [0 3 0]\n";
  for (const LightSelection selection : {LightSelection::Uniform, LightSelection::Power}) {
    PhotonSettings settings;
    settings.lightSelection = selection;
    PhotonPassResult result =
        Shoot(lamps + "Material \"matte\"\n" + kRecordSphere, targets, settings);
    const double power[2] = {4 * M_PI, 12 * M_PI};
    const double y[2] = {double(Spectrum(1).Y()), double(Spectrum(0, 3, 0).Y())};
    int found[2] = {};
    for (const Shot& photon : ShotsOf(&result, PhotonKind::Direct)) {
      const int light = photon.power.r > 0 ? 0 : 1;
      ++found[light];
      const double share =
          selection == LightSelection::Uniform ? .5 : .95 * y[light] / (y[0] + y[1]) + .05 * .5;
      EXPECT_NEAR(double(photon.power.g) / (power[light] / share), 1, 1e-4);
    }
    EXPECT_GT(found[0], 100);
    EXPECT_GT(found[1], 100);
  }
}

// A site holds the reflectance of the diffuse lobes, and the share of the glossy lobes in the
// luminance of all.
TEST(PhotonRecords, OfRadiancePhotonsHoldTheDiffuseLobesAndTheGlossyShare) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = 4000;
  targets.radianceFraction = Real(.25);
  PhotonPassResult result = Shoot(
      kRecordLamp +
          "Material \"translucent\" \"color Kd\" [.5 .4 .2] \"color Ks\" [.2 .1 .3] \"color "
          "reflect\" [.4 .4 .6] \"color transmit\" [.5 .3 .2] \"float roughness\" .2 \"string "
          "fresnel\" \"physical\"\n" +
          kRecordFloor,
      targets);
  const auto sites = result.sites.Records();
  EXPECT_NEAR(double(sites.size()) / double(result[PhotonKind::Direct].photons.Size()), .25, .04);
  ASSERT_GT(sites.size(), 100u);
  const Spectrum reflectance(Real(.2), Real(.16), Real(.12));
  const Spectrum transmittance(Real(.25), Real(.12), Real(.04));
  const Spectrum albedo = MicrofacetAlbedo(5, Fresnel::Dielectric(1, Real(1.5)));
  const Spectrum gloss =
      (Spectrum(Real(.2), Real(.1), Real(.3)) * Spectrum(Real(.4), Real(.4), Real(.6)) +
       Spectrum(Real(.2), Real(.1), Real(.3)) * Spectrum(Real(.5), Real(.3), Real(.2))) *
      albedo;
  const double share = double(gloss.Y()) / double((gloss + reflectance + transmittance).Y());
  for (const RadiancePhotonSite& site : sites) {
    ExpectRelative(site.reflectance, reflectance);
    ExpectRelative(site.transmittance, transmittance);
    EXPECT_NEAR(double(site.glossyShare), share, 1e-5);
    EXPECT_FALSE(site.isCoated);
    EXPECT_EQ(site.n, Normal3(0, 0, 1));
    EXPECT_NEAR(double(site.p.z), 0, 1e-6);
  }
  PhotonPassResult coated = Shoot(kRecordLamp + "Material \"substrate\"\n" + kRecordFloor, targets);
  for (const RadiancePhotonSite& site : coated.sites.Records()) EXPECT_TRUE(site.isCoated);
  PhotonPassResult matte = Shoot(kRecordLamp + "Material \"matte\"\n" + kRecordFloor, targets);
  for (const RadiancePhotonSite& site : matte.sites.Records()) {
    EXPECT_EQ(site.glossyShare, 0);
    EXPECT_EQ(site.transmittance, Spectrum());
  }
}

// In a closed sphere every path stores a direct photon. Batches have 64, 128, 256 ... paths,
// and the one that reaches the limit is the last.
TEST(PhotonRecords, StopAtTheFirstBatchBeyondTheirLimitOfPaths) {
  PhotonTargets targets;
  targets[PhotonKind::Direct] = 1000000;
  PhotonSettings settings;
  for (const auto& [limit, paths] : {std::pair{1, 64}, std::pair{64, 64}, std::pair{65, 192}}) {
    settings.maxPhotonPaths = limit;
    PhotonPassResult result =
        Shoot(kRecordLamp + "Material \"matte\"\n" + kRecordSphere, targets, settings);
    EXPECT_EQ(result.paths, paths) << limit;
    EXPECT_EQ(result[PhotonKind::Direct].paths, paths);
    EXPECT_EQ(result[PhotonKind::Direct].photons.Size(), std::size_t(paths));
    EXPECT_NEAR(result.emittedPower / double(result.paths), double(Emitted().Y()), 1e-3);
  }
}

// White walls keep all power, so the limit of depth cuts all of it.
TEST(PhotonRecords, OfWhiteWallsAreCutWithAllTheirPower) {
  PhotonTargets targets;
  targets[PhotonKind::Indirect] = 1000;
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Luminance;
  settings.maxPhotonDepth = 3;
  settings.maxPhotonPaths = 300;
  const PhotonPassResult result = Shoot(
      kRecordLamp + "Material \"matte\" \"color Kd\" [1 1 1]\n" + kRecordSphere, targets, settings);
  EXPECT_NEAR(result.cutPower / result.emittedPower, 1, 1e-3);
  EXPECT_EQ(result.droppedPhotons, 0);
  EXPECT_EQ(result.divergingPaths, 0);
}

}  // namespace
}  // namespace exphoton
