// SPDX-License-Identifier: BSD-2-Clause
// These tests check which caustics count as light that paths from the camera never find.
#include "core/transport/path/unseen_light.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

using Phrases = std::vector<std::string>;

const std::string kPoint = "LightSource \"point\" \"point from\" [0 0 1]\n";
const std::string kLamp =
    "AttributeBegin AreaLightSource \"area\" Shape \"sphere\" \"float radius\" .1 AttributeEnd\n";
const std::string kWall = "Material \"matte\"\nTranslate 0 0 4 Shape \"disk\"\n";
const std::string kMirror = "Material \"mirror\"\nTranslate 0 0 -8 Shape \"disk\"\n";

Phrases UnseenIn(const std::string& world, const std::string& effects = "auto") {
  LoadOptions options;
  options.effects = effects;
  const LoadedScene loaded = LoadSceneText(
      TestHeader("\"path\"", 4, 4, 1) + "WorldBegin\n" + world + "WorldEnd\n", options);
  return UnseenByPaths(*loaded.setup->scene);
}

TEST(UnseenByPaths, NamesCausticsOfLightsWithoutASize) {
  EXPECT_EQ(UnseenIn(kPoint + kLamp + kWall + kMirror),
            Phrases{"caustics of a light without a size"});
  EXPECT_EQ(UnseenIn(kPoint + kPoint + kWall + kMirror),
            Phrases{"caustics of 2 lights without a size"});
}

TEST(UnseenByPaths, NamesNothingThatPathsFind) {
  EXPECT_EQ(UnseenIn(kLamp + kWall + kMirror), Phrases{});
  EXPECT_EQ(UnseenIn(kPoint + kWall), Phrases{});
}

// The plan has caustics then, but there is no mirror.
TEST(UnseenByPaths, NeedsAMirrorWithAllEffects) {
  EXPECT_EQ(UnseenIn(kPoint + kWall, "all"), Phrases{});
}

TEST(UnseenByPaths, LeavesOutLightsThatReachNoMirror) {
  const std::string spot =
      "LightSource \"spot\" \"point from\" [0 0 2] \"point to\" [0 0 4] \"float coneangle\" 20\n";
  EXPECT_EQ(UnseenIn(spot + kWall + kMirror), Phrases{});
  EXPECT_EQ(UnseenIn("LightSource \"point\" \"color I\" [0 0 0]\n" + kWall + kMirror), Phrases{});
}

}  // namespace
}  // namespace exphoton
