// SPDX-License-Identifier: BSD-2-Clause
// These tests compare hits on an instance with hits on the same instance times a power of two,
// which rounds in the same way.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "core/math/sampling/random.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::string InstanceScene(const std::string& scale, const std::string& shape) {
  return "Accelerator \"bvh\"\nWorldBegin\nObjectBegin \"a\"\n" + shape + "\nObjectEnd\n" + scale +
         "Translate .3 .2 -.1 Rotate 40 1 2 3 Scale .7 1.2 .9 ObjectInstance \"a\"\nWorldEnd\n";
}

Vector3 InCube(RandomStream* random) {
  Vector3 v;
  v.x = 2 * random->Uniform() - 1;
  v.y = 2 * random->Uniform() - 1;
  v.z = 2 * random->Uniform() - 1;
  return v;
}

void ExpectSameHits(const std::string& shape, double scale) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), " %.17g", scale);
  const std::string directive = std::string("Scale") + text.data() + text.data() + text.data();
  const LoadedScene scene = LoadSceneText(InstanceScene("", shape));
  const LoadedScene scaled = LoadSceneText(InstanceScene(directive + "\n", shape));
  RandomStream random(3);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    Ray ray;
    const Vector3 from = InCube(&random) * Real(2);
    ray.o = Point3() + from;
    ray.d = Normalize(InCube(&random));
    const auto hit = scene.setup->scene->IntersectPoint(ray);
    ray.o = Point3() + from * Real(scale);
    const auto other = scaled.setup->scene->IntersectPoint(ray);
    ASSERT_EQ(hit.has_value(), other.has_value()) << shape << directive << i;
    if (!hit) continue;
    ++hits;
    EXPECT_LT(Distance(hit->point.p, other->point.p * Real(1 / scale)), 1e-5) << shape << i;
  }
  EXPECT_GT(hits, 50) << shape;
}

TEST(HugeInstances, AreHitByTheSameRays) {
  for (const char* const shape :
       {R"(Shape "sphere")", R"(Shape "disk")", R"(Shape "cylinder")", R"(Shape "cone")",
        R"(Shape "paraboloid")",
        R"(Shape "hyperboloid" "point p1" [.8 .1 -.6] "point p2" [-.3 .5 .7])",
        R"(Shape "trianglemesh" "integer indices" [0 1 2 0 3 1 0 2 3]
           "point P" [0 0 0 1 0 0 0 1 0 0 0 2])"}) {
    ExpectSameHits(shape, 0x1p61);
    ExpectSameHits(shape, 0x1p-61);
  }
}

}  // namespace
}  // namespace exphoton
