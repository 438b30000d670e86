// SPDX-License-Identifier: BSD-2-Clause
// Gather rays that are all too short for radiance photons and take one more bounce instead: what
// they bring must be what path tracing finds, with several lights to choose from.
#include <gtest/gtest.h>

#include "tests/support/equivalence.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TEST(ShortGather, WithOneMoreBounceIsAsBrightAsPathTracing) {
  const auto mean = [](const std::string& integrator, int samples) {
    const std::string scene =
        "Translate 0 0 -.5\n" + TestHeader(integrator, 4, 4, samples) +
        "WorldBegin\nLightSource \"point\" \"color I\" [1 1 1]\nLightSource \"point\" \"point "
        "from\" [.2 .1 -.3] \"color I\" [2 2 2]\nMaterial \"matte\" \"color Kd\" [.5 .5 .5]\n"
        "ReverseOrientation Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";
    return EstimateOverSeeds([&](std::uint64_t seed) {
      TestRenderOptions options;
      options.seed = seed;
      return MeanRadiance(RenderSceneText(scene, options).image);
    });
  };
  const double truth = mean("\"path\" \"integer maxdepth\" 40", 256).mean;
  EXPECT_TRUE(IsWithin(
      .02,
      mean("\"exphotonmap\" \"integer indirectphotons\" 20000 \"float shortrays\" 1000 \"string "
           "shortgather\" \"gather\" \"integer finalgathersamples\" 16",
           16),
      truth));
}

}  // namespace
}  // namespace exphoton
