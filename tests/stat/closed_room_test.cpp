// SPDX-License-Identifier: BSD-2-Clause
// These tests render deep interreflection in a closed, furnished room. No light may be lost in
// corners and along edges, with any accelerator. Every surface emits 1 and reflects 0.8, so the
// radiance is 5 everywhere. The tolerance is 1 %, by the rule of equivalence.h.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/equivalence.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string MeshText(const TriangleList& triangles) {
  std::ostringstream indices, points;
  points.precision(9);
  int next = 0;
  for (const auto& triangle : triangles) {
    for (const Point3& p : triangle) {
      points << p.x << " " << p.y << " " << p.z << "  ";
      indices << next++ << " ";
    }
  }
  return "Shape \"trianglemesh\" \"integer indices\" [" + indices.str() + "] \"point P\" [" +
         points.str() + "]\n";
}

std::string RoomScene(const std::string& accelerator, int samples = 32) {
  std::string text = TestHeader("\"path\" \"integer maxdepth\" 90", 32, 24, samples);
  text += "Accelerator " + accelerator +
          "\nWorldBegin\n"
          "Material \"matte\" \"color Kd\" [.8 .8 .8]\n"
          "AreaLightSource \"area\" \"color L\" [1 1 1]\n";
  text += "AttributeBegin\nReverseOrientation\n" +
          MeshText(BoxTriangles({-2, Real(-1.3), -1}, {2, Real(1.7), 4})) + "AttributeEnd\n";
  text += MeshText(BoxTriangles({-1, Real(-1.2), 2}, {Real(.3), Real(-.4), Real(3.1)}));
  text += MeshText(BoxTriangles({Real(.7), Real(-.9), Real(1.5)}, {Real(1.9), Real(-.8), 3}));
  text += "Translate -1 1 3\nRotate 30 1 1 0\nShape \"sphere\" \"float radius\" .3\nWorldEnd\n";
  return text;
}

SeedEstimate MeanOf(const std::string& scene) {
  return EstimateOverSeeds([&](std::uint64_t seed) {
    TestRenderOptions options;
    options.seed = seed;
    return MeanRadiance(RenderSceneText(scene, options).image);
  });
}

TEST(ClosedRoom, LosesNoLight) { EXPECT_TRUE(IsWithin(0.01, MeanOf(RoomScene("\"kdtree\"")), 5)); }

TEST(ClosedRoom, LooksTheSameWithEveryAccelerator) {
  const auto truth = RenderSceneText(RoomScene("\"bruteforce\"", 2)).image.pixels;
  for (const char* accelerator :
       {"\"kdtree\"", "\"kdtree\" \"integer maxprims\" 4", "\"kdtree\" \"integer maxdepth\" 2"}) {
    EXPECT_EQ(RenderSceneText(RoomScene(accelerator, 2)).image.pixels, truth) << accelerator;
  }
}

}  // namespace
}  // namespace exphoton
