// SPDX-License-Identifier: BSD-2-Clause
// These tests prove that spots cannot reach specular surfaces, and compare pictures with and
// without the proof.
#include "integrators/photon/shooting/emission/caustic_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/lights/emission_cone.h"
#include "core/math/sampling/random.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

TEST(EmissionCone, NeverMissesABoxThatItsRaysHit) {
  RandomStream random(HashKey({1}));
  const auto uniform = [&] { return random.Uniform(); };
  const auto pair = [&] {
    const Real x = uniform();
    return Point2(x, uniform());
  };
  int misses = 0;
  for (int i = 0; i < 20000; ++i) {
    const double angle = double(uniform()) * (i % 3 == 0 ? 3.14159 : .3);
    const Vector3 axis = SampleUniformSphere(pair());
    const EmissionCone cone{Point3(uniform(), uniform(), uniform()), axis, angle};
    const Point3 center = cone.apex + SampleUniformSphere(pair()) * (4 * uniform());
    const Vector3 half(uniform(), Real(.1) * uniform(), uniform());
    const Bounds3 box{center - half, center + half};
    misses += !cone.MayHit(box);
    const Vector3 local = SampleUniformCone(pair(), Real(1 - std::cos(angle)));
    const Vector3 w = Frame::FromZ(axis).ToWorld(local);
    EXPECT_TRUE(cone.MayHit(box) || !IntersectBox(box, cone.apex, w, kInfinity)) << i;
  }
  EXPECT_GT(misses, 5000);
}

std::string CausticWorld(const std::string& lights) {
  return "Camera \"perspective\" \"float fov\" 60\nFilm \"image\" \"integer xresolution\" 12 "
         "\"integer yresolution\" 8\nSampler \"lowdiscrepancy\" \"integer pixelsamples\" 2\n"
         "SurfaceIntegrator \"exphotonmap\" \"integer causticphotons\" 2000 \"integer "
         "indirectphotons\" 2000 \"integer maxphotonpaths\" 200000 \"bool guideemission\" "
         "\"false\"\nWorldBegin\n" +
         lights +
         "Material \"matte\" ReverseOrientation Shape \"sphere\" \"float radius\" 6\n"
         "AttributeBegin Material \"glass\" Translate 2 0 4 Shape \"sphere\" \"float radius\" .5 "
         "AttributeEnd\nWorldEnd\n";
}
const std::string kAway =
    "LightSource \"spot\" \"point from\" [-2 2 2] \"point to\" [-2 0 2] \"color I\" [9 9 9]\n";
const std::string kTowards =
    "LightSource \"spot\" \"point from\" [-2 2 2] \"point to\" [2 0 4] \"color I\" [.2 .2 .2]\n";

// Of the light `first` and kTowards, only `first` makes no caustics.
void ExpectOutOfReach(const std::string& first) {
  const LoadedScene scene = LoadSceneText(CausticWorld(first + kTowards));
  const CausticLights lights(*scene.setup->scene);
  EXPECT_TRUE(lights.IsOutOfReach(0)) << first;
  EXPECT_FALSE(lights.IsOutOfReach(1)) << first;
  EXPECT_EQ(lights.OutOfReachCount(), 1) << first;
  EXPECT_FALSE(lights.AreImpossible()) << first;
}

TEST(CausticLights, AreKnownByTheirCones) {
  ExpectOutOfReach(kAway);
  const LoadedScene dark = LoadSceneText(CausticWorld(kAway + kAway));
  EXPECT_TRUE(CausticLights(*dark.setup->scene).AreImpossible());
  const LoadedScene point = LoadSceneText(CausticWorld(kAway + "LightSource \"point\"\n"));
  EXPECT_FALSE(CausticLights(*point.setup->scene).AreImpossible());
}

// It shines downwards.
const std::string kProjector =
    "AttributeBegin Translate -2 2 2 Rotate 90 1 0 0 LightSource \"projection\" \"float fov\" 40 "
    "\"color I\" [9 9 9] AttributeEnd\n";

TEST(CausticLights, ProjectorsHaveCones) {
  ExpectOutOfReach(kProjector);
  std::string towards = kProjector;
  towards.replace(towards.find("90 1 0 0"), 8, "60 0 1 0");
  const LoadedScene other = LoadSceneText(CausticWorld(towards));
  EXPECT_FALSE(CausticLights(*other.setup->scene).IsOutOfReach(0));
  std::string stretched = kProjector;
  stretched.replace(stretched.find("LightSource"), 11, "Scale 1 1 .1 LightSource");
  const LoadedScene unknown = LoadSceneText(CausticWorld(stretched));
  EXPECT_FALSE(CausticLights(*unknown.setup->scene).IsOutOfReach(0));
}

// Returns 0 where there is no such counter.
double CountOf(const TestRender& render, const char* name) {
  const double count = render.Counter(name);
  return count > 0 ? count : 0;
}

// With all effects, paths have times. The guide must not learn from them.
TEST(CausticLights, LeaveGuidedEmissionAsItIs) {
  std::string world = CausticWorld(kAway + kTowards);
  world.replace(world.find("200000"), 6, "2000000");
  world.replace(world.find("\"false\""), 7, "\"true\"");
  world.replace(world.find(" .5 "), 3, " .2");
  Image images[2];
  for (int i = 0; i < 2; ++i) {
    TestRenderOptions options;
    options.load.effects = i == 0 ? "auto" : "all";
    const TestRender render = RenderSceneText(world, options);
    images[i] = render.image;
    EXPECT_GT(CountOf(render, "photons/guided"), 0);
  }
  EXPECT_EQ(images[0].pixels, images[1].pixels);
}

// Both pictures have the same photons, of paths with the same numbers.
TEST(CausticLights, LeaveThePictureAsItIs) {
  for (const std::string& lights : {kAway + kTowards, kProjector + kTowards, kAway + kAway}) {
    Image images[2];
    double skipped[2], outOfReach[2], stored[2];
    for (int i = 0; i < 2; ++i) {
      TestRenderOptions options;
      options.seed = 3;
      options.load.effects = i == 0 ? "auto" : "all";
      const TestRender render = RenderSceneText(CausticWorld(lights), options);
      images[i] = render.image;
      skipped[i] = CountOf(render, "photons/skipped");
      outOfReach[i] = CountOf(render, "photons/out of reach");
      stored[i] = CountOf(render, "photons/caustic stored");
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(outOfReach[1], 0);
    EXPECT_EQ(stored[0], stored[1]);
    EXPECT_GT(skipped[1], 1000);
    if (lights == kAway + kAway) continue;  // no path is for caustics alone
    EXPECT_EQ(skipped[0], skipped[1]);
    EXPECT_GT(outOfReach[0], skipped[0] / 2);
    EXPECT_GT(stored[0], 100);
  }
}

}  // namespace
}  // namespace exphoton
