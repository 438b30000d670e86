// SPDX-License-Identifier: BSD-2-Clause
// These tests compare photon maps with and without guided emission: their power for each kind of
// light, where photons lie, pictures, and the number of paths. Guiding must change nothing but
// noise and time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/stat/integrators/comparison.h"
#include "tests/support/equivalence.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// A glass ball of radius 1/2 over a floor of 12 by 12.
std::string World(const std::string& light) {
  return "WorldBegin\n" + light +
         "Material \"matte\" \"color Kd\" [.5 .5 .5]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
         "\"point P\" [-6 -6 0  6 -6 0  6 6 0  -6 6 0]\n"
         "Material \"glass\" Translate 1 0 1 Shape \"sphere\" \"float radius\" .5\nWorldEnd\n";
}

PhotonPassResult Shoot(const Scene& scene, PhotonKind kind, std::int64_t count, bool isGuided,
                       std::uint64_t seed) {
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Luminance;
  settings.lightSelection = LightSelection::Power;
  settings.guideEmission = isGuided;
  PhotonTargets targets;
  targets[kind] = count;
  return ShootPhotons(scene, seed, targets, settings);
}

// The floor has kCells x kCells cells.
constexpr int kCells = 4;
using Powers = std::array<double, kCells * kCells + 1>;  // of each cell, then of all

Powers PowersOf(PhotonPassResult* result, PhotonKind kind, double side) {
  Powers powers{};
  const double paths = double((*result)[kind].paths);
  for (const PhotonRecord& photon : (*result)[kind].photons.Records()) {
    const double power = double(photon.power.Power().Y()) / paths;
    powers.back() += power;
    const int x = int(std::floor((double(photon.p.x) / side + .5) * kCells));
    const int y = int(std::floor((double(photon.p.y) / side + .5) * kCells));
    if (x >= 0 && x < kCells && y >= 0 && y < kCells) powers[std::size_t(y * kCells + x)] += power;
  }
  return powers;
}

struct Case {
  const char* name;
  const char* light;
  double minGain;  // paths without a guide over paths with it
};

class GuidedEmission : public testing::TestWithParam<Case> {};

// Both estimates have 16 seeds. The sum of the squared differences of all cells in units of their
// noise follows a chi-square distribution, about: the limit is far out in its tail.
TEST_P(GuidedEmission, KeepsPowerAndPlacesOfCausticPhotons) {
  const LoadedScene loaded = LoadSceneText(World(GetParam().light));
  constexpr int kSeeds = 16;
  constexpr std::int64_t kCount = 4000;
  std::array<std::array<std::vector<double>, std::tuple_size_v<Powers>>, 2> values;
  std::array<double, 2> paths{};
  for (int guided = 0; guided < 2; ++guided)
    for (int seed = 1; seed <= kSeeds; ++seed) {
      PhotonPassResult result = Shoot(*loaded.setup->scene, PhotonKind::Caustic, kCount, guided > 0,
                                      std::uint64_t(1000 * seed + guided));
      paths[std::size_t(guided)] += double(result.paths);
      EXPECT_EQ(result.guidedPaths > 0, guided > 0);
      const Powers powers = PowersOf(&result, PhotonKind::Caustic, 6);
      for (std::size_t c = 0; c < powers.size(); ++c)
        values[std::size_t(guided)][c].push_back(powers[c]);
    }
  double sum = 0;
  int cells = 0;
  for (std::size_t c = 0; c < std::tuple_size_v<Powers>; ++c) {
    const SeedEstimate off = EstimateFrom(values[0][c]), on = EstimateFrom(values[1][c]);
    const double variance = (off.standardDeviation * off.standardDeviation +
                             on.standardDeviation * on.standardDeviation) /
                            kSeeds;
    if (!(variance > 0)) continue;
    const double z2 = (on.mean - off.mean) * (on.mean - off.mean) / variance;
    const bool isSum = c == kCells * kCells;
    if (isSum) {
      EXPECT_LT(z2, 16) << "power with guide " << on.mean << ", without " << off.mean;
      EXPECT_NEAR(on.mean, off.mean, .03 * off.mean);
    }
    if (isSum || !(off.mean > 1e-3 * EstimateFrom(values[0].back()).mean)) continue;
    sum += z2;
    ++cells;
  }
  EXPECT_GE(cells, 1);
  EXPECT_LT(sum, cells + 5 * std::sqrt(2. * cells) + 5);
  EXPECT_GT(paths[0], GetParam().minGain * paths[1])
      << "without guide " << paths[0] << ", with " << paths[1];
}

INSTANTIATE_TEST_SUITE_P(
    Lights, GuidedEmission,
    testing::Values(
        Case{"Point", "LightSource \"point\" \"point from\" [-2 0 4]\n", 5},
        Case{"Spot",
             "LightSource \"spot\" \"point from\" [-2 0 4] \"point to\" [0 0 0] "
             "\"float coneangle\" 50\n",
             2},
        Case{"Area",
             "AttributeBegin AreaLightSource \"area\" Translate -1 0 4 ReverseOrientation "
             "Shape \"disk\" \"float radius\" 1 AttributeEnd\n",
             2},
        Case{"Distant", "LightSource \"distant\" \"point from\" [-1 0 2] \"point to\" [0 0 0]\n",
             5},
        Case{"Infinite", "LightSource \"infinite\"\n", 2},
        Case{"TwoLights",
             "LightSource \"point\" \"point from\" [-2 0 4] LightSource \"point\" "
             "\"point from\" [3 3 2] \"color I\" [.2 .2 .2]\n",
             4}),
    [](const auto& info) { return info.param.name; });

// A sun over a box with a small hole: nearly all photons meet the black lid.
const char* const kBox =
    "WorldBegin\nLightSource \"distant\" \"point from\" [.3 .2 1] \"point to\" [0 0 0]\n"
    "Material \"matte\" \"color Kd\" [.5 .5 .5]\nAttributeBegin Scale 4 4 4 Translate -.5 -.5 0\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  0 1 5 0 5 4  1 2 6 1 6 5  2 3 7 2 7 "
    "6 "
    " 3 0 4 3 4 7] \"point P\" [0 0 0  1 0 0  1 1 0  0 1 0  0 0 1  1 0 1  1 1 1  0 1 1]\n"
    "Material \"matte\" \"color Kd\" [0 0 0]\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3  4 5 6 4 6 7  8 9 10 8 10 11 "
    " 12 13 14 12 14 15] \"point P\" [0 0 1  1 0 1  1 .45 1  0 .45 1  0 .55 1  1 .55 1  1 1 1  "
    "0 1 1  0 .45 1  .45 .45 1  .45 .55 1  0 .55 1  .55 .45 1  1 .45 1  1 .55 1  .55 .55 1]\n"
    "AttributeEnd\nWorldEnd\n";

TEST(GuidedSun, KeepsTheIndirectPowerWithFewerPaths) {
  const LoadedScene loaded = LoadSceneText(kBox);
  std::array<std::vector<double>, 2> powers;
  std::array<double, 2> paths{};
  for (std::size_t guided = 0; guided < 2; ++guided)
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
      PhotonPassResult result =
          Shoot(*loaded.setup->scene, PhotonKind::Indirect, 8000, guided > 0, 1000 * seed + guided);
      powers[guided].push_back(PowersOf(&result, PhotonKind::Indirect, 4).back());
      paths[guided] += double(result.paths);
    }
  const SeedEstimate off = EstimateFrom(powers[0]), on = EstimateFrom(powers[1]);
  EXPECT_NEAR(on.mean, off.mean, on.halfWidth + off.halfWidth);
  EXPECT_NEAR(on.mean, off.mean, .03 * off.mean);
  EXPECT_GT(paths[0], 3 * paths[1]) << paths[0] << ", " << paths[1];
}

// Photons inside the box have nearly the same weight.
TEST(GuidedSun, KeepsWeightsNearlyEqual) {
  const LoadedScene loaded = LoadSceneText(kBox);
  PhotonPassResult result = Shoot(*loaded.setup->scene, PhotonKind::Indirect, 8000, true, 1);
  double sum = 0, squares = 0;
  const auto photons = result[PhotonKind::Indirect].photons.Records();
  for (const PhotonRecord& photon : photons) {
    sum += double(photon.power.Power().Y());
    squares += double(photon.power.Power().Y()) * double(photon.power.Power().Y());
  }
  EXPECT_GT(sum * sum / squares, .8 * double(photons.size()));
}

// The guide changes where photons start, and not how much power the light emits.
TEST(GuidedSun, ReportsTheSamePowerWithAndWithoutGuide) {
  const auto power = [](const char* isGuided) {
    const std::string integrator =
        "SurfaceIntegrator \"exphotonmap\" \"integer indirectphotons\" 4000 \"integer "
        "causticphotons\" 0 \"integer directphotons\" 0 \"bool guideemission\" [\"" +
        std::string(isGuided) + "\"]\n";
    const TestRender render = RenderSceneText(
        "Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n" + integrator + kBox);
    EXPECT_EQ(render.Counter("photons/guided") > 0, isGuided[0] == 't');
    return render.Counter("photons/emitted power");
  };
  EXPECT_NEAR(power("true"), power("false"), 1e-3 * power("false"));
}

// guidedpath guides the emission of its photons unless the scene says otherwise.
TEST(GuidedSun, TakesFewerPathsForGuidedPath) {
  const auto shot = [](const std::string& parameter) {
    const std::string integrator =
        "SurfaceIntegrator \"guidedpath\" \"integer indirectphotons\" 20000 " + parameter + "\n";
    return RenderSceneText("Film \"image\" \"integer xresolution\" 1 \"integer yresolution\" 1\n" +
                           integrator + kBox)
        .Counter("photons/shot");
  };
  EXPECT_LT(3 * shot(""), shot("\"bool guideemission\" [\"false\"]"));
}

// Photons from before the guide and from its training are dropped. The table of lights counts none
// of them.
TEST(GuidedSun, CountsThePhotonsInTheMapsForItsLight) {
  const LoadedScene loaded = LoadSceneText(kBox);
  PhotonSettings settings;
  settings.guideEmission = true;
  PhotonTargets targets;
  targets[PhotonKind::Direct] = targets[PhotonKind::Indirect] = 8000;
  const PhotonPassResult result = ShootPhotons(*loaded.setup->scene, 1, targets, settings);
  ASSERT_GT(result.guidedPaths, 0);
  ASSERT_EQ(result.lights.size(), 1u);
  EXPECT_EQ(std::size_t(result.lights[0].stored), result[PhotonKind::Direct].photons.Size() +
                                                      result[PhotonKind::Indirect].photons.Size());
}

TEST(GuidedEmissionThreads, DoNotChangeTheMaps) {
  const LoadedScene loaded =
      LoadSceneText(World("LightSource \"point\" \"point from\" [-2 0 4]\n"));
  PhotonSettings settings;
  settings.guideEmission = true;
  PhotonTargets targets;
  targets[PhotonKind::Caustic] = 3000;
  PhotonPassResult one = ShootPhotons(*loaded.setup->scene, 1, targets, settings, 1);
  PhotonPassResult three = ShootPhotons(*loaded.setup->scene, 1, targets, settings, 3);
  EXPECT_GT(one.guidedPaths, 0);
  const auto a = one[PhotonKind::Caustic].photons.Records();
  const auto b = three[PhotonKind::Caustic].photons.Records();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].p, b[i].p) << i;
    ASSERT_EQ(a[i].power.Power(), b[i].power.Power()) << i;
  }
}

// The limit of paths holds, and does not leave a map empty that had photons.
TEST(GuidedEmissionLimit, HoldsForTrainingToo) {
  const LoadedScene loaded =
      LoadSceneText(World("LightSource \"point\" \"point from\" [-2 0 4]\n"));
  for (const std::int64_t limit : {20000, 100000, 400000}) {
    PhotonSettings settings;
    settings.guideEmission = true;
    settings.maxPhotonPaths = limit;
    PhotonTargets targets;
    targets[PhotonKind::Caustic] = 1000000;
    PhotonPassResult result = ShootPhotons(*loaded.setup->scene, 1, targets, settings);
    EXPECT_LT(result.paths, limit + PhotonTracer::kMaxGrownBatchPaths);
    EXPECT_GT(result[PhotonKind::Caustic].paths, limit / 2);
    EXPECT_GT(result[PhotonKind::Caustic].photons.Size(), 20u);
  }
}

// A small glass ball in a large room brings about 1/800 of the light.
const char* const kRoomWithASmallBall =
    "WorldBegin\nLightSource \"point\" \"point from\" [-2 0 4]\n"
    "Material \"matte\" \"color Kd\" [.5 .5 .5] Shape \"sphere\" \"float radius\" 8\n"
    "Material \"glass\" Translate 1 0 1 Shape \"sphere\" \"float radius\" .3\nWorldEnd\n";

PhotonPassResult ShootInRoom(std::optional<std::int64_t> causticPhotons) {
  const LoadedScene loaded = LoadSceneText(kRoomWithASmallBall);
  PhotonSettings settings;
  settings.photonRoulette = PhotonRoulette::Luminance;
  settings.guideEmission = true;
  settings.causticPhotons = causticPhotons;
  PhotonTargets targets;
  targets[PhotonKind::Caustic] = 20000;
  targets[PhotonKind::Indirect] = 100000;
  return ShootPhotons(*loaded.setup->scene, 1, targets, settings);
}

double PowerPerPhoton(PhotonPassResult* result, PhotonKind kind) {
  const double count = double((*result)[kind].photons.Size());
  return PowersOf(result, kind, 1).back() / count;
}

// The ball has a radius of .062 here. 1 path in 18,700 meets it, which is about 7 of the first 2^17
// paths. Without a guide, 200 photons would take 3.7 million paths.
TEST(CausticPhotons, AreGuidedIfEnoughPathsKeepSomeAtLast) {
  std::string room = kRoomWithASmallBall;
  room.replace(room.find(" .3"), 3, " .062");
  const LoadedScene loaded = LoadSceneText(room);
  PhotonPassResult result = Shoot(*loaded.setup->scene, PhotonKind::Caustic, 200, true, 1);
  EXPECT_GT(result.guidedPaths, 0);
  EXPECT_LT(result.paths, 1000000);
  const double sine = .062 / std::sqrt(18.), power = 2 * M_PI * (1 - std::sqrt(1 - sine * sine));
  EXPECT_NEAR(PowersOf(&result, PhotonKind::Caustic, 1).back(), power, .2 * power);
}

// Caustic photons need not be weaker than 1/16 of an indirect photon. The limit comes from the last
// round of training, which is the size of the noise.
TEST(CausticPhotons, AreFewerWhereTheyCarryLittleLight) {
  PhotonPassResult chosen = ShootInRoom({});
  const std::int64_t count = std::int64_t(chosen[PhotonKind::Caustic].photons.Size());
  EXPECT_GT(count, 1000);
  EXPECT_LT(count, 6000);
  EXPECT_GE(count, chosen.enoughCaustics);
  EXPECT_LT(count, chosen.enoughCaustics + 4096);  // a batch
  const double ratio =
      PowerPerPhoton(&chosen, PhotonKind::Indirect) / PowerPerPhoton(&chosen, PhotonKind::Caustic);
  EXPECT_NEAR(ratio * double(chosen.enoughCaustics) / double(count), 16, 1.6);

  PhotonPassResult asked = ShootInRoom(20000);
  EXPECT_GE(asked[PhotonKind::Caustic].photons.Size(), 20000u);
  EXPECT_NEAR(double(asked.enoughCaustics), double(chosen.enoughCaustics), 200);
  EXPECT_NEAR(PowersOf(&asked, PhotonKind::Caustic, 1).back(),
              PowersOf(&chosen, PhotonKind::Caustic, 1).back(),
              .1 * PowersOf(&asked, PhotonKind::Caustic, 1).back());
}

}  // namespace
}  // namespace exphoton
