// SPDX-License-Identifier: BSD-2-Clause
// These tests prove that spots and one-sided area lights cannot reach specular surfaces, and
// compare pictures with and without the proof.
#include "core/transport/specular/caustic_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/lights/emission_cone.h"
#include "core/math/half_space.h"
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

std::string AreaLamp(const std::string& shape) {
  return "AttributeBegin AreaLightSource \"area\" \"color L\" [9 9 9] " + shape + " AttributeEnd\n";
}
const std::string kDiskLamp = "Shape \"disk\" \"float radius\" .5";
// Two triangles and one that is tilted by 45 degrees. All face the direction of +z.
const std::string kMeshLamp =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 1 4 2] "
    "\"point P\" [0 0 0  1 0 0  1 1 0  0 1 0  2 0 1]";

// Returns an area light of any shape at a random place, which is mirrored, stretched or reversed.
std::string RandomAreaLamp(RandomStream* random) {
  const auto number = [random] { return std::to_string(4 * random->Uniform() - 2) + " "; };
  const auto any = [random](std::initializer_list<std::string> texts) {
    return texts.begin()[std::size_t(random->Uniform() * Real(texts.size()))] + " ";
  };
  std::string shape = "Translate ";
  for (int axis = 0; axis < 3; ++axis) shape += number();
  shape += any({"", "", "ActiveTransform EndTime Rotate 70 1 0 0 ActiveTransform All"});
  for (const char* axis : {"1 0 0 ", "0 1 0 "})
    shape += "Rotate " + std::to_string(360 * random->Uniform()) + " " + axis;
  shape += any({"", "Scale 1 1 -1", "Scale -2 1 .3"});
  shape += any({"", "ReverseOrientation"});
  shape += any({kDiskLamp, kMeshLamp, kDiskLamp + " \"float height\" 1 \"float phimax\" 70",
                "Shape \"sphere\" \"float zmin\" .8", "Shape \"cylinder\""});
  return AreaLamp(shape);
}

TEST(OneSided, NeverMissesABoxThatItsRaysHit) {
  RandomStream random(11);
  const auto pair = [&] {
    const Real x = random.Uniform();
    return Point2(x, random.Uniform());
  };
  std::string world =
      "TransformTimes 0 1\nCamera \"perspective\" \"float shutterclose\" 1\nWorldBegin\n";
  for (int i = 0; i < 100; ++i) world += RandomAreaLamp(&random);
  const LoadedScene scene = LoadSceneText(world + "WorldEnd\n");
  const auto& lights = scene.setup->scene->Lights();
  ASSERT_EQ(lights.size(), 100u);
  int misses = 0;
  for (int i = 0; i < 4000; ++i) {
    const Light& light = *lights[std::size_t(i) % lights.size()];
    const Point3 center =
        light.Bounds()->Center() + SampleUniformSphere(pair()) * (2 * random.Uniform());
    const Vector3 half = Vector3(random.Uniform(), Real(.1), random.Uniform()) * Real(.3);
    const Bounds3 box{center - half, center + half};
    if (dynamic_cast<const OneSided&>(light).MayFace(box)) continue;
    ++misses;
    for (int j = 0; j < 100; ++j) {
      const auto emitted = light.SampleEmission(pair(), pair(), random.Uniform(), random.Uniform());
      ASSERT_TRUE(emitted);
      EXPECT_FALSE(IntersectBox(box, emitted->ray.o, emitted->ray.d, kInfinity)) << i;
    }
  }
  EXPECT_GT(misses, 400);
}

TEST(OneSided, IsExactForFlatSurfaces) {
  const Bounds3 box{{-1, 2, -1}, {1, 3, 1}};
  const Normal3 up = Normalize(Normal3(0, 1, 1));
  // The plane through the edge of the box that is the farthest along its normal.
  const auto liesBehind = [&](double shift) {
    const Point3 p = Point3(0, 3, 1) + up * Real(shift);
    return LiesBehind(box, up, {p + Vector3(1, 0, 0), p + Vector3(0, 1, -1)});
  };
  EXPECT_TRUE(liesBehind(.001));
  EXPECT_FALSE(liesBehind(0));
  EXPECT_FALSE(liesBehind(-.001));
  EXPECT_FALSE(LiesBehind({{-1, -kInfinity, -1}, {1, 0, 1}}, {0, 1, 0}, {{0, 5, 0}}));
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

// The ball lies at z > 3.
const std::string kPanelAway = AreaLamp("Translate -2 0 2 Rotate 180 1 0 0 " + kDiskLamp);

TEST(CausticLights, FlatAreaLightsHaveAHalfSpace) {
  ExpectOutOfReach(kPanelAway);
  ExpectOutOfReach(AreaLamp("Translate -2 0 2 ReverseOrientation Scale 2 1 3 " + kDiskLamp));
  ExpectOutOfReach(AreaLamp("Translate -2 0 2 Scale 1 1 -1 " + kMeshLamp));
  ExpectOutOfReach(AreaLamp(
      "Translate -2 0 2 Rotate 150 1 0 0 ReverseOrientation Rotate 180 1 0 0 " + kDiskLamp));
  for (const std::string& shape :
       {kDiskLamp, kMeshLamp, "Rotate 100 1 0 0 " + kDiskLamp, "Rotate 130 0 1 0 " + kMeshLamp,
        std::string("Shape \"sphere\" \"float radius\" .5")}) {
    const LoadedScene scene = LoadSceneText(CausticWorld(AreaLamp("Translate -2 0 2 " + shape)));
    EXPECT_FALSE(CausticLights(*scene.setup->scene).IsOutOfReach(0)) << shape;
  }
}

// The ball of the scene stays behind the panel. Another one comes before it.
TEST(CausticLights, CountTheWholeExposure) {
  const auto isOutOfReach = [](const std::string& motion) {
    const std::string world = CausticWorld(
        kPanelAway + "AttributeBegin Material \"mirror\" Translate 0 0 4 ActiveTransform EndTime " +
        motion + " ActiveTransform All Shape \"sphere\" \"float radius\" .5 AttributeEnd\n");
    std::string moving = "TransformTimes 0 1\n" + world;
    moving.replace(moving.find("\"float fov\" 60"), 14,
                   "\"float fov\" 60 \"float shutterclose\" 1");
    const LoadedScene scene = LoadSceneText(moving);
    return CausticLights(*scene.setup->scene).IsOutOfReach(0);
  };
  EXPECT_TRUE(isOutOfReach("Translate 0 3 0"));
  EXPECT_FALSE(isOutOfReach("Translate 0 0 -3"));
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
  const std::string fog =
      "Volume \"homogeneous\" \"color sigma_a\" [.01 .01 .01] \"color sigma_s\" [.05 .05 .05] "
      "\"point p0\" [-6 -6 -6] \"point p1\" [6 6 6]\n";
  for (const std::string& lights :
       {kAway + kTowards, kProjector + kTowards, kPanelAway + kTowards, fog + kPanelAway + kTowards,
        kAway + kAway, kPanelAway + kAway}) {
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
    if (!lights.ends_with(kTowards)) continue;  // no path is for caustics alone
    EXPECT_EQ(skipped[0], skipped[1]);
    EXPECT_GT(outOfReach[0], skipped[0] / 2);
    EXPECT_GT(stored[0], 100);
  }
}

}  // namespace
}  // namespace exphoton
