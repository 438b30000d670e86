// SPDX-License-Identifier: BSD-2-Clause
// These tests check cameras: rays computed by hand, lens, clipping, time, scaled cameras and
// parameter ranges.
#include "core/imaging/film/camera.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

constexpr Point2 kLensCentre{Real(.5), Real(.5)};

void ExpectNear(const Vec3& a, const Vec3& b, double tolerance = 1e-6) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

// Returns the ray's point at depth z in camera space, for a camera at the origin.
Point3 AtDepth(const Ray& ray, Real z) { return ray((z - ray.o.z) / ray.d.z); }

TEST(PerspectiveCamera, LooksAlongZWithXRightAndFilmYDown) {
  TestPlugins plugins;
  const auto camera = plugins.MakeCamera(R"("perspective" "float fov" 90)", {}, 200, 100);
  const auto at = [&](Real x, Real y) {
    return AtDepth(camera->GenerateRay({{x, y}, kLensCentre, 0}, false), 1);
  };
  ExpectNear(at(100, 50), {0, 0, 1});
  ExpectNear(at(0, 0), {-2, 1, 1});  // the shorter axis spans 90 degrees
  ExpectNear(at(200, 100), {2, -1, 1});
  ExpectNear(at(150, 50), {1, 0, 1});
}

TEST(PerspectiveCamera, FovIsThatOfTheShorterAxisOfATallImage) {
  TestPlugins plugins;
  const auto camera = plugins.MakeCamera(R"("perspective" "float fov" 60)", {}, 100, 300);
  const Ray ray = camera->GenerateRay({{100, 150}, kLensCentre, 0}, false);
  ExpectNear(AtDepth(ray, 1), {std::tan(Radians(30)), 0, 1});
  ExpectNear(AtDepth(camera->GenerateRay({{50, 0}, kLensCentre, 0}, false), 1),
             {0, 3 * std::tan(Radians(30)), 1});
}

TEST(PerspectiveCamera, ScreenWindowAndAspectRatioReplaceTheFilms) {
  TestPlugins plugins;
  const auto window =
      plugins.MakeCamera(R"("perspective" "float screenwindow" [-.5 1 -2 0])", {}, 30, 10);
  ExpectNear(AtDepth(window->GenerateRay({{0, 0}, kLensCentre, 0}, false), 1), {Real(-.5), 0, 1});
  ExpectNear(AtDepth(window->GenerateRay({{30, 10}, kLensCentre, 0}, false), 1), {1, -2, 1});
  const auto aspect =
      plugins.MakeCamera(R"("perspective" "float frameaspectratio" .5)", {}, 30, 10);
  ExpectNear(AtDepth(aspect->GenerateRay({{0, 0}, kLensCentre, 0}, false), 1), {-1, 2, 1});
}

TEST(PerspectiveCamera, StartsAtHitherAndEndsAtYon) {
  TestPlugins plugins;
  const auto camera =
      plugins.MakeCamera(R"("perspective" "float hither" 2 "float yon" 10)", {}, 10, 10);
  for (Point2 film : {Point2(5, 5), Point2(0, 0), Point2(9, 1)}) {
    const Ray ray = camera->GenerateRay({film, kLensCentre, 0}, false);
    EXPECT_NEAR(Length(ray.d), 1, 1e-6);
    EXPECT_NEAR(ray.o.z, 2, 1e-5);
    EXPECT_NEAR(ray(ray.tMax).z, 10, 1e-4);
  }
}

TEST(PerspectiveCamera, RaysThroughTheLensMeetInTheFocalPlane) {
  TestPlugins plugins;
  const auto camera = plugins.MakeCamera(
      R"("perspective" "float lensradius" .5 "float focaldistance" 10)", {}, 40, 40);
  EXPECT_TRUE(camera->HasLens());
  const Point2 film(33, 12);
  const Point3 focus = AtDepth(camera->GenerateRay({film, kLensCentre, 0}, false), 10);
  for (Point2 lens : {Point2(0, Real(.5)), Point2(Real(.9), Real(.3)), Point2(Real(.5), 0)}) {
    const Ray ray = camera->GenerateRay({film, lens, 0}, false);
    ExpectNear(AtDepth(ray, 10), focus, 1e-5);
    const Point3 onLens = AtDepth(ray, 0);
    const Point2 disk = SampleDisk(lens) * Real(.5);
    ExpectNear(onLens, {disk.x, disk.y, 0}, 1e-5);
  }
}

TEST(PerspectiveCamera, TimeRunsOverTheShutter) {
  TestPlugins plugins;
  const auto camera =
      plugins.MakeCamera(R"("perspective" "float shutteropen" 2 "float shutterclose" 4)", {}, 4, 4);
  EXPECT_EQ(camera->Shutter().min, 2);
  EXPECT_EQ(camera->Shutter().max, 4);
  EXPECT_FALSE(camera->HasLens());
  EXPECT_EQ(camera->GenerateRay({{1, 1}, kLensCentre, Real(.25)}, false).time, Real(2.5));
}

TEST(PerspectiveCamera, ScalingItDoesNotBreakDirections) {
  TestPlugins plugins;
  for (double scale : {1e-20, 1e-3, 1024., 1e15}) {
    const auto toWorld = *Transform::Scale(scale, scale, scale);
    const auto camera =
        plugins.MakeCamera(R"("perspective" "float hither" 1 "float yon" 3)", toWorld, 10, 10);
    const Ray ray = camera->GenerateRay({{0, 0}, kLensCentre, 0}, false);
    ExpectNear(ray.d, Vector3(-1, 1, 1) / std::sqrt(Real(3)));
    EXPECT_NEAR(double(ray.o.z) / scale, 1, 1e-5);
    EXPECT_NEAR(double(ray.tMax) / scale, 2 * std::sqrt(3.), 1e-4);
  }
  const auto mirrored = plugins.MakeCamera(R"("perspective")", *Transform::Scale(-1, 1, 4), 2, 2);
  const Ray ray = mirrored->GenerateRay({{0, 1}, kLensCentre, 0}, false);
  ExpectNear(ray.d, Vector3(1, 0, 4) / std::sqrt(Real(17)));
}

TEST(PerspectiveCamera, FollowsLookAt) {
  TestPlugins plugins;
  const auto worldToCamera = *Transform::LookAt({0, 10, 100}, {0, -1, 0}, {0, 1, 0});
  const auto camera = plugins.MakeCamera(R"("perspective")", worldToCamera.Inverted(), 200, 200);
  const Ray ray = camera->GenerateRay({{100, 100}, kLensCentre, 0}, false);
  ExpectNear(ray.d, Normalize(Vector3(0, -11, -100)));
  ExpectNear(ray.o, {0, 10, 100}, 2e-3);
  const Ray right = camera->GenerateRay({{200, 100}, kLensCentre, 0}, false);
  ExpectNear(right.d - ray.d * Dot(right.d, ray.d), {std::sqrt(Real(.5)), 0, 0}, 1e-5);
}

TEST(PerspectiveCamera, DifferentialsAreTheNeighboursRays) {
  TestPlugins plugins;
  for (const char* name : {"\"perspective\"", "\"orthographic\"", "\"environment\""}) {
    const auto camera = plugins.MakeCamera(name, {}, 20, 20);
    const RayDifferential ray = camera->GenerateRay({{7, 8}, kLensCentre, 0}, true);
    ASSERT_TRUE(ray.hasDifferentials);
    const Ray x = camera->GenerateRay({{8, 8}, kLensCentre, 0}, false);
    const Ray y = camera->GenerateRay({{7, 9}, kLensCentre, 0}, false);
    EXPECT_EQ(ray.xOrigin, x.o);
    EXPECT_EQ(ray.xDirection, x.d);
    EXPECT_EQ(ray.yOrigin, y.o);
    EXPECT_EQ(ray.yDirection, y.d);
    EXPECT_FALSE(camera->GenerateRay({{7, 8}, kLensCentre, 0}, false).hasDifferentials);
  }
}

// Version 1 has no other convention to compare with. NDC is -1..1 over the window with y up, and
// 0..1 over the depth.
TEST(PerspectiveCamera, NdcSpansMinusOneToOne) {
  TestPlugins plugins;
  for (const char* name : {R"("perspective" "float hither" 1 "float yon" 5)",
                           R"("orthographic" "float hither" 1 "float yon" 5)"}) {
    const auto toWorld = Transform::Translate({1, 2, 3});
    const auto camera = plugins.MakeCamera(name, toWorld, 200, 100);
    const Ray ray = camera->GenerateRay({{150, 25}, kLensCentre, 0}, false);
    const Matrix4 m = camera->WorldToNdc();
    const auto project = [&](const Point3& p) {
      const double v[4] = {double(p.x), double(p.y), double(p.z), 1};
      double r[4] = {};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) r[i] += m.m[i][j] * v[j];
      return Point3(Real(r[0] / r[3]), Real(r[1] / r[3]), Real(r[2] / r[3]));
    };
    ExpectNear(project(ray.o), {Real(.5), Real(.5), 0}, 1e-5);
    ExpectNear(project(ray(ray.tMax)), {Real(.5), Real(.5), 1}, 1e-5);
  }
}

// The window is off centre by different amounts along x and y.
TEST(PerspectiveCamera, NdcFollowsTheWindow) {
  TestPlugins plugins;
  for (const std::string name : {"perspective", "orthographic"}) {
    const auto camera = plugins.MakeCamera(
        "\"" + name + "\" \"float screenwindow\" [-1 .5 .2 .8] \"float yon\" 5", {}, 200, 100);
    const Ray ray = camera->GenerateRay({{150, 25}, kLensCentre, 0}, false);
    const Matrix4 m = camera->WorldToNdc();
    const Point3 p = ray(ray.tMax / 2);
    const double v[4] = {double(p.x), double(p.y), double(p.z), 1};
    double r[4] = {};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) r[i] += m.m[i][j] * v[j];
    EXPECT_NEAR(r[0] / r[3], .5, 1e-5) << name;
    EXPECT_NEAR(r[1] / r[3], .5, 1e-5) << name;
  }
}

TEST(OrthographicCamera, HasParallelRays) {
  TestPlugins plugins;
  const auto camera = plugins.MakeCamera(R"("orthographic" "float hither" 0)", {}, 200, 100);
  const Ray ray = camera->GenerateRay({{0, 0}, kLensCentre, 0}, false);
  ExpectNear(ray.o, {-2, 1, 0});
  ExpectNear(ray.d, {0, 0, 1});
  const auto lens = plugins.MakeCamera(
      R"("orthographic" "float lensradius" .5 "float focaldistance" 4)", {}, 200, 100);
  const Ray through = lens->GenerateRay({{100, 0}, {Real(.9), Real(.2)}, 0}, false);
  ExpectNear(AtDepth(through, 4), {0, 1, 4}, 1e-5);
  EXPECT_GT(std::abs(through.d.x), Real(.01));
}

TEST(EnvironmentCamera, MapsLatitudeAndLongitude) {
  TestPlugins plugins;
  const auto camera =
      plugins.MakeCamera(R"("environment" "float hither" 1 "float yon" 5)", {}, 200, 100);
  const auto direction = [&](Real x, Real y) {
    return camera->GenerateRay({{x, y}, kLensCentre, 0}, false).d;
  };
  ExpectNear(direction(50, 0), {0, 1, 0});
  ExpectNear(direction(0, 50), {1, 0, 0});
  ExpectNear(direction(50, 50), {0, 0, 1});
  ExpectNear(direction(100, 50), {-1, 0, 0});
  const Ray ray = camera->GenerateRay({{0, 50}, kLensCentre, 0}, false);
  ExpectNear(ray.o, {1, 0, 0});
  EXPECT_NEAR(ray.tMax, 4, 1e-5);
}

TEST(Camera, ExtremeParametersGiveFiniteRays) {
  TestPlugins plugins;
  for (const char* text : {
           R"("perspective" "float fov" 1e-3)",
           R"("perspective" "float fov" 179.99)",
           R"("perspective" "float fov" 179.9999)",
           R"("perspective" "float lensradius" 1e15 "float focaldistance" 1e-15)",
           R"("perspective" "float lensradius" 1e15)",
           R"("orthographic" "float lensradius" 1e6 "float focaldistance" 1e-6)",
           R"("perspective" "float hither" 0)",
           R"("perspective" "float frameaspectratio" 1e6)",
       }) {
    const auto camera = plugins.MakeCamera(text, {}, 640, 480);
    for (Point2 film : {Point2(320, 240), Point2(0, 0), Point2(640, 480), Point2(-3, 500)}) {
      for (Point2 lens : {kLensCentre, Point2(0, 0), Point2(Real(.99), Real(.1))}) {
        const RayDifferential ray = camera->GenerateRay({film, lens, 0}, true);
        EXPECT_TRUE(IsFinite(ray.o) && IsFinite(ray.d)) << text;
        EXPECT_TRUE(IsFinite(ray.xOrigin) && IsFinite(ray.yDirection)) << text;
        EXPECT_NEAR(Length(ray.d), 1, 1e-5) << text;
        EXPECT_GE(ray.tMax, 0) << text;
      }
    }
  }
}

TEST(Camera, ParametersOutOfRangeAreErrors) {
  TestPlugins plugins;
  for (const char* text : {
           R"("perspective" "float fov" 0)",
           R"("perspective" "float fov" 180)",
           R"("perspective" "float fov" -5)",
           R"("perspective" "float hither" 5 "float yon" 4)",
           R"("perspective" "float hither" -1)",
           R"("perspective" "float lensradius" -1)",
           R"("perspective" "float lensradius" .5 "float focaldistance" 0)",
           R"("perspective" "float shutteropen" 3)",
           R"("perspective" "float screenwindow" [0 1 2])",
           R"("perspective" "float screenwindow" [0 0 1 2])",
           R"("orthographic" "float frameaspectratio" 0)",
       }) {
    EXPECT_THROW(plugins.MakeCamera(text, {}, 64, 48), Error) << text;
  }
}

}  // namespace
}  // namespace exphoton
