// SPDX-License-Identifier: BSD-2-Clause
// These tests check the bounding boxes of specular surfaces. No ray that hits such a surface may
// miss the boxes. The caustic map must be the same if paths that miss the boxes are skipped.
#include "core/transport/specular/specular_boxes.h"

#include <gtest/gtest.h>

#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/photon_shots.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

// The room has matte walls, a mirror sphere, a glass disk, a disk that only refracts, a mesh, and a
// moving instance.
const char* const kRoom = R"(
WorldBegin
LightSource "point" "point from" [0 3 0]
Shape "sphere" "float radius" 9
AttributeBegin
  Material "mirror" Translate 2 0 0 Shape "sphere" "float radius" .5
  Material "glass" Translate -4 1 0 Shape "disk" "float radius" .7
  Material "glass" "color Kr" [0 0 0] Translate 4 3 3 Shape "disk" "float radius" .7
  Material "uber" "color Kr" [.1 .1 .1]
  Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
    "point P" [-1 -2 1  1 -2 1  1 -2 2  -1 -2 2]
AttributeEnd
Material "mirror"
ObjectBegin "ball"
  Shape "sphere" "float radius" .3
ObjectEnd
AttributeBegin
  ActiveTransform EndTime
  Translate 0 0 3
  ActiveTransform All
  Translate 0 1 -4
  ObjectInstance "ball"
AttributeEnd
WorldEnd
)";

const char* const kShutter =
    "TransformTimes 0 1\nCamera \"perspective\" \"float shutterclose\" 1\n";

TEST(SpecularBoxes, HoldAllThatRaysMeetOfSpecularSurfaces) {
  const LoadedScene loaded = LoadSceneText(std::string(kShutter) + kRoom);
  const Scene& scene = *loaded.setup->scene;
  const SpecularBoxes boxes(scene);
  RandomStream random(7);
  int hits = 0, passed = 0, refracting = 0;
  for (int i = 0; i < 200000; ++i) {
    const auto u = [&random] { return random.Uniform(); };
    const Point3 from(8 * u() - 4, 8 * u() - 4, 8 * u() - 4);
    RayDifferential ray(Ray(from, SampleUniformSphere({u(), u()})));
    ray.time = u();
    const bool misses = boxes.Misses(ray);
    passed += misses;
    const auto hit = scene.Intersect(ray);
    if (!hit || !Intersects(hit->material->PossibleLobes(), LobeSet::Specular)) continue;
    ++hits;
    refracting += !Intersects(hit->material->PossibleLobes(), LobeSet::Reflection);
    ASSERT_FALSE(misses) << hit->p.x << " " << hit->p.y << " " << hit->p.z;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(refracting, 100);
  EXPECT_GT(passed, 100000);
}

TEST(PrimitiveSet, HasTheLobesOfAllItsInstances) {
  const std::string object = "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd ObjectInstance \"o\"\n";
  for (const std::string materials : {"mirror matte", "matte mirror"}) {
    const std::size_t blank = materials.find(' ');
    const LoadedScene loaded = LoadSceneText(
        "WorldBegin\nMaterial \"" + materials.substr(0, blank) + "\" " + object + "Material \"" +
        materials.substr(blank + 1) + "\" Translate 5 0 0 " + object + "WorldEnd\n");
    const LobeSet lobes = loaded.setup->scene->Primitives().PossibleLobes();
    EXPECT_TRUE(Intersects(lobes, LobeSet::Specular)) << materials;
    EXPECT_TRUE(Intersects(lobes, LobeSet::Diffuse)) << materials;
  }
}

TEST(SpecularBoxes, OfASceneWithoutSpecularSurfacesLetEveryRayPass) {
  const LoadedScene loaded = LoadSceneText("WorldBegin\nShape \"sphere\"\nWorldEnd\n");
  const SpecularBoxes boxes(*loaded.setup->scene);
  EXPECT_TRUE(boxes.Boxes().empty());
  EXPECT_TRUE(boxes.Misses(Ray(Point3(0, 0, -3), Vector3(0, 0, 1))));
}

// No path can be skipped while the direct map still needs photons.
TEST(SpecularBoxes, DoNotChangeThePhotonsOfTheCausticMap) {
  const LoadedScene loaded = LoadSceneText(kRoom);
  PhotonSettings settings;
  settings.maxPhotonPaths = 1 << 16;
  const auto shoot = [&](std::int64_t direct) {
    PhotonTargets targets;
    targets[PhotonKind::Caustic] = 1 << 20;
    targets[PhotonKind::Direct] = direct;
    return ShootPhotons(*loaded.setup->scene, 1, targets, settings);
  };
  PhotonPassResult all = shoot(1 << 20), causticsAlone = shoot(0);
  EXPECT_EQ(all.skipped, 0);
  EXPECT_GT(causticsAlone.skipped, 3 * causticsAlone.paths / 4);
  EXPECT_EQ(all.paths, causticsAlone.paths);
  const auto expected = all[PhotonKind::Caustic].photons.Records();
  const auto found = causticsAlone[PhotonKind::Caustic].photons.Records();
  ASSERT_GT(expected.size(), 500u);
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(expected[i].p, found[i].p);
    ASSERT_EQ(expected[i].power.Power(), found[i].power.Power());
  }
}

}  // namespace
}  // namespace exphoton
