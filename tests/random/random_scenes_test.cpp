// SPDX-License-Identifier: BSD-2-Clause
// This test checks random scenes with fixed seeds. It is the short form of ./dev soak.
#include <gtest/gtest.h>

#include "tests/random/scenes/run.h"

namespace exphoton::random_scenes {
namespace {

void ExpectNoFailure(const SceneRun& run) {
  for (const Failure& failure : run.Failures())
    ADD_FAILURE() << failure.property << ", seed " << failure.seed << ": " << failure.detail << "\n"
                  << failure.text;
}

TEST(RandomScenes, KeepTheirPixelsWithEveryPlanThreadCountAndAccelerator) {
  SceneRun run({});
  for (std::uint64_t seed = 1; seed <= 200; ++seed) run.CheckInvariances(seed);
  ExpectNoFailure(run);
}

TEST(RandomScenes, KeepTheirPixelsWithEachVariation) {
  SceneRun run({});
  for (std::uint64_t seed = 1; seed <= 100; ++seed) run.Add(kVariations, seed);
  ExpectNoFailure(run);
}

TEST(RandomScenes, ShowTheSumOverTheirBouncesInAFurnace) {
  SceneRun run({.maxStatisticalTries = 0});
  for (std::uint64_t seed = 1; seed <= 24; ++seed) run.Add(kSums, seed);
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

// With these seeds the three wrong pictures of tests/mutations/pictures.names that lack light of
// fog or of glossy surfaces are found.
TEST(RandomScenes, LookTheSameInSpheresWithFogOrGlossyWalls) {
  SceneRun run({.maxStatisticalTries = 0});
  for (std::uint64_t seed = 9000001; seed <= 9000012; ++seed) run.Add(kPhotons, seed);
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

// Hardly any path of this scene finds the light that comes from a small spot over glossy walls.
TEST(RandomScenes, RaiseNoAlarmWhereFewPathsFindALight) {
  SceneRun run({.maxStatisticalTries = 0});
  run.Add(kPairs, 179568759100020);
  run.JudgeComparisons();
  EXPECT_GT(run.Repeated(), 0);
  ExpectNoFailure(run);
}

TEST(RandomScenes, LoseKnownPartsOfEachAovWhereSurfacesAreDarker) {
  SceneRun run({.maxStatisticalTries = 0});
  for (std::uint64_t seed = 9000001; seed <= 9000006; ++seed) run.Add(kLayers, seed);
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

TEST(RandomScenes, LookTheSameWithPhotonsThatPassGlassAndTurnedNormals) {
  SceneRun run({.maxStatisticalTries = 0});
  for (std::uint64_t seed = 9000001; seed <= 9000004; ++seed) run.Add(kGathers, seed);
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

TEST(RandomScenes, HavePartsThatFitTogether) {
  SceneRun run({});
  for (std::uint64_t seed = 1; seed <= 12; ++seed) run.CheckProbes(seed);
  ExpectNoFailure(run);
}

TEST(RandomScenes, GiveNoMoreEnergyThanTheyGet) {
  SceneRun run({});
  for (std::uint64_t seed = 1; seed <= 200; ++seed) run.CompareEnergy(seed);
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

TEST(RandomScenes, LookTheSameToPathTracersAndPhotonIntegrators) {
  SceneRun run({.maxStatisticalTries = 0});
  for (std::uint64_t seed = 1; seed <= 16; ++seed) run.CompareAgreement(seed);
  run.CompareAgreement(44);  // detects glossy lobes that radiance photons treat as diffuse
  run.JudgeComparisons();
  ExpectNoFailure(run);
}

}  // namespace
}  // namespace exphoton::random_scenes
