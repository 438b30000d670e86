// SPDX-License-Identifier: BSD-2-Clause
// Tests of scenes that are loaded in a build with EXPHOTON_STOCHASTIC. A directive changes the
// transformation at both times of the exposure. Computed twice, the two would differ by roundings,
// and everything would move.
#ifdef EXPHOTON_STOCHASTIC

#include <gtest/gtest.h>

#include "tests/rounding/runtime/rounding.h"
#include "tests/support/test_scene.h"

namespace exphoton::rounding {
namespace {

TEST(RoundingScenes, StandStillWithoutActiveTransform) {
  for (std::uint64_t key = 1; key <= 20; ++key) {
    RoundAtRandom(key);
    const LoadedScene scene = LoadSceneText(
        "Rotate 17 1 2 3\nLookAt .1 .2 -.9  .3 -.1 .7  .1 1 .3\nCamera \"perspective\"\n"
        "WorldBegin\nRotate 33 3 1 2\nScale 1.1 1.3 1.7\nLightSource \"point\"\n"
        "AreaLightSource \"area\"\nShape \"sphere\"\nWorldEnd\n");
    RoundAtRandom(0);
    EXPECT_FALSE(scene.setup->scene->Features().Needs(Feature::Motion)) << key;
  }
}

}  // namespace
}  // namespace exphoton::rounding

#endif
