// SPDX-License-Identifier: BSD-2-Clause
// These tests check the points that the camera sees, from which photons of distant lights are
// targeted, the share of such lights, and the pose at rest of moving surfaces.
#include "integrators/photon/shooting/visible_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/math/sampling/random.h"
#include "integrators/photon/maps/rest_pose.h"
#include "tests/support/test_scene.h"

namespace exphoton {
namespace {

std::vector<Point3> PointsOf(const std::string& world, std::uint64_t seed = 1) {
  const LoadedScene loaded = LoadSceneText(
      "Film \"image\" \"integer xresolution\" 40 \"integer yresolution\" 20\nCamera "
      "\"orthographic\" \"float screenwindow\" [-2 2 -1 1]\nWorldBegin\nLightSource "
      "\"distant\"\n" +
      world + "WorldEnd\n");
  RenderSetup& setup = *loaded.setup;
  std::vector<Point3> points;
  for (const VisiblePoint& point : VisiblePoints(*setup.scene, *setup.camera, {40, 20}, seed))
    points.push_back(point.p);
  return points;
}

const std::string kWall =
    "AttributeBegin Translate 0 0 2 Shape \"disk\" \"float radius\" 50 AttributeEnd\n";

// 1024 camera rays fill each of 8 x 8 parts of the picture with 16 points.
TEST(VisiblePoints, FillThePictureEvenly) {
  const std::vector<Point3> points = PointsOf("Material \"matte\"\n" + kWall);
  ASSERT_EQ(points.size(), 1024u);
  std::vector<int> cells(64, 0);
  for (const Point3& p : points) {
    EXPECT_NEAR(double(p.z), 2, 1e-5);
    const int x = int((double(p.x) + 2) * 2), y = int((double(p.y) + 1) * 4);
    ASSERT_TRUE(x >= 0 && x < 8 && y >= 0 && y < 8) << p.x << ' ' << p.y;
    ++cells[std::size_t(8 * y + x)];
  }
  for (const int count : cells) EXPECT_NEAR(count, 16, 4);
  EXPECT_FALSE(points == PointsOf("Material \"matte\"\n" + kWall, 2));
}

// Each point of the wall sends one ray on, which meets the second wall; a mirror is no such point.
TEST(VisiblePoints, IncludeWhatTheFirstPointsSeeAndFollowMirrors) {
  const std::string back =
      "Translate 0 0 -3 Shape \"disk\" \"float radius\" 5000\n";  // behind the camera
  const std::vector<Point3> matte = PointsOf("Material \"matte\"\n" + kWall + back);
  EXPECT_NEAR(double(matte.size()), 2048, 4);
  int behind = 0;
  for (const Point3& p : matte) behind += p.z < 0;
  EXPECT_NEAR(behind, 1024, 4);
  const std::vector<Point3> mirror =
      PointsOf("Material \"mirror\"\n" + kWall + "Material \"matte\"\n" + back);
  // Every first point is on the second wall, seen in the mirror.
  int seen = 0;
  for (const Point3& p : mirror) seen += std::abs(p.x) < 2 && std::abs(p.y) < 1 && p.z < Real(-2.9);
  EXPECT_GE(seen, 1024);
  EXPECT_TRUE(PointsOf("Material \"mirror\"\n" + kWall).empty());
  EXPECT_TRUE(PointsOf("").empty());
}

// Photons of a targeted sun are as many times denser as they are fewer.
TEST(VisiblePoints, TakePhotonsFromTheSunAsTheyBecomeDenser) {
  const TestRender render = RenderSceneText(
      TestHeader("\"photonmap\" \"string photonaim\" \"on\" \"string lightselection\" \"power\" "
                 "\"integer indirectphotons\" 0 \"integer causticphotons\" 0 \"integer "
                 "directphotons\" 4000",
                 4, 4, 1) +
      "WorldBegin\nLightSource \"distant\" \"color L\" [1 1 1] \"point from\" [0 0 0] \"point to\" "
      "[0 0 1]\nLightSource \"point\" \"color I\" [2000 2000 2000]\nMaterial \"matte\"\nTranslate "
      "0 "
      "0 4 Shape \"disk\" \"float radius\" 5 Translate 0 0 100 Shape \"disk\" \"float radius\" 60\n"
      "WorldEnd\n");
  const double gain = render.Counter("photons/targeting gain");
  ASSERT_GT(gain, 2);
  // The sphere round both disks: the box is 120 x 120 x 100.
  const double sun = M_PI * (60. * 60 + 60 * 60 + 50 * 50) / gain, lamp = 4 * M_PI * 2000;
  const double shot = render.Counter("lights/1 distant shot");
  const double share = shot / (shot + render.Counter("lights/2 point shot"));
  EXPECT_NEAR(share, .95 * sun / (sun + lamp) + .025, .02);
}

// With photonaim "on", a notice gives the reason why photons are not aimed.
TEST(VisiblePoints, AreNotAimedAtBesideFogOrIfThereAreTooFew) {
  const auto render = [](const std::string& header, const std::string& world) {
    return RenderSceneText(
        TestHeader("\"photonmap\" \"string photonaim\" \"on\" \"integer indirectphotons\" 200 "
                   "\"integer maxphotonpaths\" 1000",
                   4, 4, 1) +
        header +
        "WorldBegin\nLightSource \"distant\" \"point from\" [0 0 -9] \"point to\" [0 0 0]\n" +
        "Material \"matte\"\n" + world + "WorldEnd\n");
  };
  const std::string aimed = "start towards visible points", unaimed = "photonaim has no effect";
  const std::string fog = "Volume \"homogeneous\" \"color sigma_s\" [.1 .1 .1]\n";
  const std::string single = "VolumeIntegrator \"single\"\n";
  const TestRender clear = render("", kWall), dim = render("", kWall + fog);
  for (const TestRender* other : {&clear, &dim}) {
    EXPECT_TRUE(other->Says(aimed));
    EXPECT_FALSE(other->Says(unaimed));
  }
  const TestRender foggy = render(single, kWall + fog);
  EXPECT_TRUE(foggy.Says(unaimed + " in a scene whose media scatter light"));
  const TestRender behind = render("", "Translate 0 0 -2 Shape \"disk\" \"float radius\" 5\n");
  EXPECT_TRUE(behind.Says(unaimed + ": the camera sees too few points of the scene"));
  for (const TestRender* other : {&foggy, &behind}) {
    EXPECT_FALSE(other->Says(aimed));
    EXPECT_TRUE(std::isnan(other->Counter("photons/targeting gain")));
  }
}

// A motion that moves, turns and stretches: everything is taken back to its start.
TEST(RestPose, TakesPointsNormalsAndDirectionsToTheStart) {
  const Transform start = Transform::Translate({1, 0, 2});
  const Transform end = Transform::Translate({3, 1, 2}) * *Transform::Rotate(60, {0, 1, 1}) *
                        *Transform::Scale(1, 3, 2);
  const char* problem = nullptr;
  const Motion motion(*AnimatedTransform::Between(start, end, {0, 1}, &problem));
  const RestPose rest(&motion, 1);
  EXPECT_TRUE(rest.IsMoved());
  RandomStream random(3);
  for (int i = 0; i < 20; ++i) {
    const Vector3 v(random.Uniform() - Real(.5), random.Uniform(), random.Uniform() - Real(.3));
    const Point3 local = Point3() + v * 3;
    const auto expectNear = [](const Vector3& a, const Vector3& b) {
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(double(a[axis]), double(b[axis]), 1e-4) << axis;
    };
    expectNear(rest.Point(end.ApplyPoint(local)) - Point3(), start.ApplyPoint(local) - Point3());
    const Vector3 w = Normalize(end.ApplyVector(v));
    expectNear(rest.Direction(w), Normalize(start.ApplyVector(v)));
    expectNear(rest.DirectionBack(rest.Direction(w)), w);
    const Normal3 n = Normal3(Normalize(Vector3(end.ApplyNormal(Normal3(v)))));
    expectNear(Vector3(rest.Normal(n)), Normalize(Vector3(start.ApplyNormal(Normal3(v)))));
  }
  // A square across the local x axis is stretched from 1 to 6, along z to 3.
  EXPECT_NEAR(double(rest.PowerScale(Normal3(Normalize(Vector3(end.ApplyNormal({1, 0, 0})))))),
              1. / 6, 1e-4);
  EXPECT_NEAR(double(rest.PowerScale(Normal3(Normalize(Vector3(end.ApplyNormal({0, 0, 1})))))),
              1. / 3, 1e-4);
  const RestPose still(nullptr, 1);
  EXPECT_FALSE(still.IsMoved());
  EXPECT_EQ(still.Point({1, 2, 3}), Point3(1, 2, 3));
  EXPECT_EQ(still.PowerScale({0, 0, 1}), 1);
}

}  // namespace
}  // namespace exphoton
