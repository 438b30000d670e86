// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the surface of a triangle, and samples of meshes and of placed and moving
// surfaces, with formulas in double precision over random triangles.
#include <gtest/gtest.h>

#include <functional>

#include "core/geometry/moving_emitter.h"
#include "core/geometry/placed_emitter.h"
#include "core/geometry/placement.h"
#include "core/geometry/triangle_mesh.h"
#include "core/geometry/vec3d.h"
#include "core/math/sampling/sampling.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

void ExpectNear(const Vec3& a, const Vec3d& b, double tolerance, const char* what) {
  EXPECT_LT(Length(Vec3d(a) - b), tolerance * (1 + Length(b))) << what;
}

enum Parts { kUv = 1, kNormals = 2, kTangents = 4, kFlip = 8 };

TriangleMesh RandomTriangle(RandomStream& random, int parts) {
  TriangleMesh mesh;
  // The second of two triangles, with vertices in another order.
  mesh.indices = {{0, 1, 2}, {4, 2, 3}};
  for (int i = 0; i < 5; ++i) mesh.p.push_back(RandomVector(random) * 2);
  const Vec3d face = NormalizeOrZero(
      Cross(Vec3d(mesh.p[2]) - Vec3d(mesh.p[4]), Vec3d(mesh.p[3]) - Vec3d(mesh.p[4])));
  const Real side = random.Uniform() < Real(.5) ? -1 : 1;
  for (int i = 0; i < 5; ++i) {
    if (parts & kUv) mesh.uv.push_back({Between(random, -1, 2), Between(random, -1, 2)});
    if (parts & kNormals)
      mesh.n.push_back(
          NormalizeOr(face.ToReal() * side + RandomVector(random) * Real(.6), {0, 0, 1}));
    if (parts & kTangents) mesh.s.push_back(NormalizeOr(RandomVector(random), {1, 0, 0}));
  }
  mesh.flipNormal = parts & kFlip;
  return mesh;
}

TEST(TriangleFormulas, GiveTheSurfaceOfAnyMesh) {
  RandomStream random(1);
  for (int k = 0; k < 800; ++k) {
    const TriangleMesh mesh = RandomTriangle(random, k % 16);
    const auto& v = mesh.indices[1];
    const Vec3d p0(mesh.p[v[0]]), p1(mesh.p[v[1]]), p2(mesh.p[v[2]]);
    const Point2 defaults[3] = {{0, 0}, {1, 0}, {1, 1}};
    const auto uvOf = [&](int i) { return mesh.uv.empty() ? defaults[i] : mesh.uv[v[i]]; };
    const Vec3d cross = Cross(p1 - p0, p2 - p0);
    const double du1 = double(uvOf(1).x - uvOf(0).x), dv1 = double(uvOf(1).y - uvOf(0).y);
    const double du2 = double(uvOf(2).x - uvOf(0).x), dv2 = double(uvOf(2).y - uvOf(0).y);
    if (Length(cross) < .3 || std::abs(du1 * dv2 - du2 * dv1) < .3) continue;
    const double b1 = double(Between(random, Real(.05), Real(.5)));
    const double b2 = double(Between(random, Real(.05), Real(.45)));
    const SurfaceInteraction s = TriangleSurface(mesh, 1, Real(b1), Real(b2));
    SCOPED_TRACE(k);

    ExpectNear(s.p, p0 * (1 - b1 - b2) + p1 * b1 + p2 * b2, 1e-6, "p");
    const Vec3d ng = NormalizeOrZero(cross) * (mesh.flipNormal ? -1 : 1);
    ExpectNear(s.ng, ng, 1e-6, "ng");
    EXPECT_NEAR(double(s.uv.x), double(uvOf(0).x) + b1 * du1 + b2 * du2, 1e-5);
    EXPECT_NEAR(double(s.uv.y), double(uvOf(0).y) + b1 * dv1 + b2 * dv2, 1e-5);
    ExpectNear((s.dpdu * Real(du1) + s.dpdv * Real(dv1)), p1 - p0, 1e-4, "along the first edge");
    ExpectNear((s.dpdu * Real(du2) + s.dpdv * Real(dv2)), p2 - p0, 1e-4, "along the second edge");
    EXPECT_EQ(s.dndu, Normal3());
    EXPECT_EQ(s.dndv, Normal3());

    Vec3d n = ng;
    if (!mesh.n.empty()) {
      const auto shading = [&](double a1, double a2) {
        const Vec3d sum = Vec3d(mesh.n[v[0]]) * (1 - a1 - a2) + Vec3d(mesh.n[v[1]]) * a1 +
                          Vec3d(mesh.n[v[2]]) * a2;
        return NormalizeOrZero(sum) * (Dot(sum, ng) < 0 ? -1 : 1);
      };
      n = shading(b1, b2);
      constexpr double e = 1e-4;
      const Vec3d by1 = (shading(b1 + e, b2) - shading(b1 - e, b2)) * (.5 / e);
      const Vec3d by2 = (shading(b1, b2 + e) - shading(b1, b2 - e)) * (.5 / e);
      const auto& t = s.shading;
      ExpectNear(t.dndu * Real(du1) + t.dndv * Real(dv1), by1, 1e-4, "normals, first edge");
      ExpectNear(t.dndu * Real(du2) + t.dndv * Real(dv2), by2, 1e-4, "normals, second edge");
    } else {
      EXPECT_EQ(s.shading.dndu, Normal3());
      EXPECT_EQ(s.shading.dndv, Normal3());
    }
    ExpectNear(s.shading.n, n, 1e-5, "shading normal");

    Vec3d first(s.dpdu), second(s.dpdv);
    const auto flat = [&](const Vec3d& a) { return NormalizeOrZero(a - n * Dot(n, a)); };
    if (!mesh.s.empty()) {
      first = flat(Vec3d(mesh.s[v[0]]) * (1 - b1 - b2) + Vec3d(mesh.s[v[1]]) * b1 +
                   Vec3d(mesh.s[v[2]]) * b2) *
              double(Length(s.dpdu));
      const double side = Dot(Cross(Vec3d(s.dpdu), Vec3d(s.dpdv)), n) < 0 ? -1 : 1;
      second = NormalizeOrZero(Cross(n, first)) * (side * double(Length(s.dpdv)));
    } else if (!mesh.n.empty()) {
      first = flat(first) * double(Length(s.dpdu));
      second = flat(second) * double(Length(s.dpdv));
    }
    ExpectNear(s.shading.dpdu, first, 1e-4, "shading.dpdu");
    ExpectNear(s.shading.dpdv, second, 1e-4, "shading.dpdv");
    if (testing::Test::HasFailure()) return;
  }
}

// Without usable texture coordinates, the tangents are as long as the triangle is wide.
TEST(TriangleFormulas, GiveTangentsAsLongAsTheTriangleIsWide) {
  TriangleMesh mesh;
  mesh.indices = {{0, 1, 2}};
  mesh.p = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}};
  mesh.uv = {{1, 2}, {2, 4}, {3, 6}};
  const SurfaceInteraction s = TriangleSurface(mesh, 0, Real(.2), Real(.3));
  EXPECT_NEAR(double(Length(s.dpdu)), 6, 1e-5);
  EXPECT_NEAR(double(Length(s.dpdv)), 6, 1e-5);
  EXPECT_NEAR(double(Dot(s.dpdu, s.dpdv)), 0, 1e-5);
  EXPECT_EQ(s.shading.dpdu, s.dpdu);
  EXPECT_EQ(s.shading.dpdv, s.dpdv);
}

// A mesh of three triangles whose areas are as 1 to 4 to 9.
TEST(MeshEmitter, SamplesTrianglesByAreaAndPointsUniformly) {
  TriangleMesh mesh;
  for (int i = 1; i <= 3; ++i) {
    const auto at = std::uint32_t(mesh.p.size());
    const Real side = Real(i), z = Real(i * 10);
    mesh.p.insert(mesh.p.end(), {{0, 0, z}, {side, 0, z}, {0, side, z + side}});
    mesh.uv.insert(mesh.uv.end(), {{0, 0}, {1, 0}, {0, 1}});
    mesh.indices.push_back({at, at + 1, at + 2});
  }
  const auto emitter = MakeMeshEmitter(mesh);
  const double area = 14 * std::sqrt(2.) / 2;
  EXPECT_NEAR(double(emitter->Area()), area, 1e-5);
  EXPECT_EQ(emitter->Bounds().min, Point3(0, 0, 10));
  EXPECT_EQ(emitter->Bounds().max, Point3(3, 3, 33));
  EXPECT_EQ(emitter->EmitterProblem(), nullptr);
  int counts[3] = {};
  RandomStream random(2);
  for (int i = 0; i < 1400; ++i) {
    const Point2 u(random.Uniform(), random.Uniform());
    const EmitterSample sample = emitter->SamplePoint(u, Real((i + .5) / 1400), 0);
    const int chosen = int(sample.point.p.z) / 10 - 1;
    ++counts[chosen];
    const Point2 b = SampleTriangle(u);
    EXPECT_LT(std::abs(sample.uv.x - b.x) + std::abs(sample.uv.y - b.y), Real(1e-6));
    const Real side = Real(chosen + 1);
    EXPECT_NEAR(double(sample.point.p.x), double(b.x * side), 1e-5);
    EXPECT_NEAR(double(sample.point.p.y), double(b.y * side), 1e-5);
    EXPECT_NEAR(double(sample.point.p.z), double(side * (10 + b.y)), 1e-4);
    EXPECT_NEAR(double(sample.pdf) * area, 1, 1e-5);
    EXPECT_NEAR(double(sample.point.ng.z), std::sqrt(.5), 1e-5);
  }
  EXPECT_NEAR(counts[0], 100, 1);
  EXPECT_NEAR(counts[1], 400, 1);
  EXPECT_NEAR(counts[2], 900, 1);
}

// A unit disk (area pi) that a map places is an ellipse, whose density of area is uniform.
const Transform kPlace = Transform::Translate({1, -2, 3}) * *Transform::Rotate(35, {1, 2, -1}) *
                         *Transform::Scale(2, 3, -1.5);

std::unique_ptr<Shape> UnitDisk(TestPlugins& plugins) {
  ShapeGeometry geometry = plugins.MakeShape(R"("disk")");
  return std::move(std::get<std::unique_ptr<Shape>>(geometry));
}

double ByArea(const SurfacePoint& ref, const SurfacePoint& on, double area) {
  const Vec3d between = Vec3d(on.p) - Vec3d(ref.p);
  const double d2 = Dot(between, between);
  return d2 * std::sqrt(d2) / (area * std::abs(Dot(between, Vec3d(on.ng))));
}

void ExpectUniformEllipse(const EmitterSurface& emitter, const EmitterSurface& local,
                          const Transform& place, double area, Real time) {
  RandomStream random(3);
  for (int i = 0; i < 50; ++i) {
    const Point2 u(random.Uniform(), random.Uniform());
    const EmitterSample sample = emitter.SamplePoint(u, Real(.5), time);
    const EmitterSample inside = local.SamplePoint(u, Real(.5), time);
    EXPECT_NEAR(double(sample.pdf) * area, 1, 1e-4);
    EXPECT_LT(Distance(sample.point.p, place.ApplyPoint(inside.point.p)), Real(1e-5));
    EXPECT_LT(Distance(sample.point.ng, NormalizeOr(place.ApplyNormal(inside.point.ng), {})),
              Real(1e-5));
    EXPECT_EQ(sample.uv, inside.uv);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_GE(sample.point.pError[axis], kMachineEpsilon * std::abs(sample.point.p[axis]));
    SurfacePoint ref;
    ref.p = Point3(1, -2, 3) + RandomVector(random) * 8;
    ref.time = time;
    const auto toward = emitter.SampleToward(ref, u, Real(.5));
    ASSERT_TRUE(toward);
    EXPECT_EQ(toward->point.time, time);
    EXPECT_LT(Distance(toward->point.p, sample.point.p), Real(1e-5));
    const double pdf = ByArea(ref, sample.point, area);
    EXPECT_NEAR(double(toward->pdf) / pdf, 1, 2e-3);
    const Vector3 wi = NormalizeOr(sample.point.p - ref.p, {});
    EXPECT_NEAR(double(emitter.PdfToward(ref, wi, sample.point)) / pdf, 1, 2e-3);
  }
}

TEST(PlacedEmitterFormulas, AreThoseOfThePlacedSurface) {
  TestPlugins plugins;
  const auto local = UnitDisk(plugins);
  const PlacedEmitter emitter(UnitDisk(plugins), kPlace);
  EXPECT_NEAR(double(emitter.Area()) / (6 * M_PI), 1, 1e-3);
  ExpectUniformEllipse(emitter, *local, kPlace, 6 * M_PI, Real(.25));
}

TEST(MovingEmitterFormulas, AreThoseOfTheSurfaceAtEachTime) {
  TestPlugins plugins;
  const std::shared_ptr<const EmitterSurface> local = UnitDisk(plugins);
  // Grows from 1 to 3 between the times 2 and 4, and moves.
  const Transform from = Transform::Translate({1, 0, 0});
  const Transform to = Transform::Translate({5, 0, 0}) * *Transform::Scale(3, 3, 3);
  const char* problem = nullptr;
  const auto animated = AnimatedTransform::Between(from, to, {2, 4}, &problem);
  ASSERT_TRUE(animated);
  const Motion motion(*animated);
  const MovingEmitter emitter(local, motion);
  // The mean of s^2 with s from 1 to 3.
  EXPECT_NEAR(double(emitter.Area()) / M_PI, 26. / 6, 1e-4);
  EXPECT_LE(emitter.Bounds().min.x, 0);
  EXPECT_GE(emitter.Bounds().max.x, 8);
  for (const Real time : {Real(2), Real(2.5), Real(4)}) {
    const double scale = double(time) - 1;
    ExpectUniformEllipse(emitter, *local, motion.At(time), M_PI * scale * scale, time);
  }
}

// The sphere sets no time itself.
TEST(PlacedEmitterFormulas, HaveTheTimeOfTheReference) {
  TestPlugins plugins;
  const auto sphere = plugins.MakeEmitter(R"("sphere")", *Transform::Scale(1, 2, 3));
  SurfacePoint ref;
  ref.p = {9, 0, 0};
  ref.time = Real(.75);
  const auto sample = sphere->SampleToward(ref, {Real(.3), Real(.6)}, Real(.5));
  ASSERT_TRUE(sample);
  EXPECT_EQ(sample->point.time, Real(.75));
}

// Coordinates of an instance are off by three roundings before the map, and keep their time.
TEST(PointToWorld, WidensTheErrorByTheRoundingOfTheInstance) {
  SurfacePoint local;
  local.p = {2, -3, 4};
  local.pError = {Real(1e-6), Real(2e-6), Real(3e-6)};
  local.ng = {0, 0, 1};
  local.time = Real(.75);
  const SurfacePoint point = PointToWorld(*Transform::Scale(2, 2, 2), local);
  EXPECT_EQ(point.time, Real(.75));
  EXPECT_EQ(point.p, Point3(4, -6, 8));
  EXPECT_EQ(PointToLocal({}, local).time, Real(.75));
  for (int axis = 0; axis < 3; ++axis) {
    const double p = std::abs(double(local.p[axis])), unit = double(kMachineEpsilon);
    const double bound = 2 * (double(local.pError[axis]) + 3 * unit * p) + unit * 2 * p;
    EXPECT_NEAR(double(point.pError[axis]) / bound, 1, 1e-5);
  }
}

// Neighbouring rays with origins and directions of their own meet the tangent plane.
TEST(Differentials, AreStepsOnTheTangentPlane) {
  RandomStream random(6);
  for (int k = 0; k < 200; ++k) {
    SurfaceInteraction s;
    s.p = RandomVector(random);
    s.dpdu = RandomVector(random), s.dpdv = RandomVector(random);
    const Vec3d u(s.dpdu), v(s.dpdv), n = NormalizeOrZero(Cross(u, v));
    if (Length(Cross(u, v)) < .2) continue;
    s.ng = n.ToReal();
    RayDifferential ray;
    ray.o = s.p + s.ng * 2, ray.d = -s.ng;
    ray.hasDifferentials = true;
    ray.xOrigin = ray.o + RandomVector(random) * Real(.1);
    ray.yOrigin = ray.o + RandomVector(random) * Real(.1);
    ray.xDirection = ray.d + RandomVector(random) * Real(.1);
    ray.yDirection = ray.d + RandomVector(random) * Real(.1);
    s.ComputeDifferentials(ray);
    ASSERT_TRUE(s.hasDifferentials);
    const auto stepOf = [&](const Point3& origin, const Vector3& direction) {
      const Vec3d o(origin), d(direction);
      return o + d * (Dot(n, Vec3d(s.p) - o) / Dot(n, d)) - Vec3d(s.p);
    };
    const Vec3d x = stepOf(ray.xOrigin, ray.xDirection), y = stepOf(ray.yOrigin, ray.yDirection);
    ExpectNear(s.dpdx, x, 1e-5, "dpdx");
    ExpectNear(s.dpdy, y, 1e-5, "dpdy");
    ExpectNear((u * double(s.dudx) + v * double(s.dvdx)).ToReal(), x, 1e-4, "x by u and v");
    ExpectNear((u * double(s.dudy) + v * double(s.dvdy)).ToReal(), y, 1e-4, "y by u and v");
    ray.xDirection = s.dpdu;  // parallel to the plane
    s.ComputeDifferentials(ray);
    if (s.hasDifferentials) continue;  // rounding left it slightly inclined
    EXPECT_EQ(s.dpdx, Vector3());
    EXPECT_EQ(s.dpdy, Vector3());
    EXPECT_EQ(s.dudx + s.dvdx + s.dudy + s.dvdy, 0);
    s.dudx = 1;
    s.ComputeDifferentials(RayDifferential());
    EXPECT_FALSE(s.hasDifferentials);
    EXPECT_EQ(s.dudx, 0);
  }
}

}  // namespace
}  // namespace exphoton
