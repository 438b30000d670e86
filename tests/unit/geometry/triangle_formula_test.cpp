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

void ExpectNearVector(const Vec3& a, const Vec3d& b, double tolerance, const char* what) {
  EXPECT_LT(Length(Vec3d(a) - b), tolerance * (1 + Length(b))) << what;
}

enum Parts { kUv = 1, kNormals = 2, kTangents = 4, kFlip = 8 };

TriangleMesh RandomTriangles(RandomStream& random, int parts) {
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

// The second triangle of a mesh, with its formulas at barycentrics (b1, b2).
class OneTriangle {
 public:
  explicit OneTriangle(const TriangleMesh& mesh) : mesh_(mesh), v_(mesh.indices[1]) {
    for (int i = 0; i < 3; ++i) p_[i] = Vec3d(mesh.p[v_[i]]);
    const Point2 defaults[3] = {{0, 0}, {1, 0}, {1, 1}};
    const auto uvOf = [&](int i) { return mesh.uv.empty() ? defaults[i] : mesh.uv[v_[i]]; };
    uv0 = uvOf(0), first = uvOf(1) - uvOf(0), second = uvOf(2) - uvOf(0);
  }
  Vec3d Cross() const { return exphoton::Cross(p_[1] - p_[0], p_[2] - p_[0]); }
  bool IsRegular() const {
    return Length(Cross()) > .3 && std::abs(first.x * second.y - second.x * first.y) > Real(.3);
  }
  Vec3d Ng() const { return NormalizeOrZero(Cross()) * (mesh_.flipNormal ? -1 : 1); }
  Vec3d Edge(int i) const { return p_[i] - p_[0]; }
  Vec3d Point(double b1, double b2) const { return p_[0] + Edge(1) * b1 + Edge(2) * b2; }
  Vec3d Blend(const std::vector<Vec3>& values, double b1, double b2) const {
    return Vec3d(values[v_[0]]) * (1 - b1 - b2) + Vec3d(values[v_[1]]) * b1 +
           Vec3d(values[v_[2]]) * b2;
  }
  Vec3d Normal(double b1, double b2) const {
    if (mesh_.n.empty()) return Ng();
    const Vec3d sum = Blend(mesh_.n, b1, b2);
    return NormalizeOrZero(sum) * (Dot(sum, Ng()) < 0 ? -1 : 1);
  }

  Point2 uv0, first, second;  // texture coordinates: of the first corner, and along two edges

 private:
  const TriangleMesh& mesh_;
  const std::array<std::uint32_t, 3>& v_;
  Vec3d p_[3];
};

// The derivatives along u and v combine to the differences along both edges.
void ExpectDerivatives(const OneTriangle& triangle, double b1, double b2,
                       const SurfaceInteraction& s) {
  const auto along = [](const Vec3& byU, const Vec3& byV, Point2 uv) {
    return byU * uv.x + byV * uv.y;
  };
  const Point2 first = triangle.first, second = triangle.second;
  ExpectNearVector(along(s.dpdu, s.dpdv, first), triangle.Edge(1), 1e-4, "along the first edge");
  ExpectNearVector(along(s.dpdu, s.dpdv, second), triangle.Edge(2), 1e-4, "along the second edge");
  constexpr double e = 1e-4;
  const Vec3d by1 = (triangle.Normal(b1 + e, b2) - triangle.Normal(b1 - e, b2)) * (.5 / e);
  const Vec3d by2 = (triangle.Normal(b1, b2 + e) - triangle.Normal(b1, b2 - e)) * (.5 / e);
  const auto& t = s.shading;
  ExpectNearVector(along(t.dndu, t.dndv, first), by1, 1e-4, "normals along the first edge");
  ExpectNearVector(along(t.dndu, t.dndv, second), by2, 1e-4, "normals along the second edge");
  EXPECT_EQ(s.dndu, Normal3());
  EXPECT_EQ(s.dndv, Normal3());
}

// `tangent` belongs to the mesh; it may be 0.
void ExpectShadingTangents(const SurfaceInteraction& s, const Vec3d& n, const Vec3d& tangent) {
  const auto flat = [&](const Vec3d& a) { return NormalizeOrZero(a - n * Dot(n, a)); };
  const double lengthU = double(Length(s.dpdu)), lengthV = double(Length(s.dpdv));
  Vec3d first = flat(Vec3d(s.dpdu)) * lengthU, second = flat(Vec3d(s.dpdv)) * lengthV;
  if (Length(tangent) > 0) {
    first = flat(tangent) * lengthU;
    const double side = Dot(Cross(Vec3d(s.dpdu), Vec3d(s.dpdv)), n) < 0 ? -1 : 1;
    second = NormalizeOrZero(Cross(n, first)) * (side * lengthV);
  }
  ExpectNearVector(s.shading.dpdu, first, 1e-4, "shading.dpdu");
  ExpectNearVector(s.shading.dpdv, second, 1e-4, "shading.dpdv");
}

TEST(TriangleFormulas, GiveTheSurfaceOfAnyMesh) {
  RandomStream random(1);
  int tested = 0;
  for (int k = 0; k < 800; ++k) {
    const TriangleMesh mesh = RandomTriangles(random, k % 16);
    const OneTriangle triangle(mesh);
    if (!triangle.IsRegular()) continue;
    ++tested;
    const double b1 = double(Between(random, Real(.05), Real(.5)));
    const double b2 = double(Between(random, Real(.05), Real(.45)));
    const SurfaceInteraction s = TriangleSurface(mesh, 1, Real(b1), Real(b2));
    SCOPED_TRACE(k);
    ExpectNearVector(s.p, triangle.Point(b1, b2), 1e-6, "p");
    ExpectNearVector(s.ng, triangle.Ng(), 1e-6, "ng");
    const Point2 uv = triangle.uv0 + triangle.first * Real(b1) + triangle.second * Real(b2);
    EXPECT_NEAR(double(s.uv.x), double(uv.x), 1e-5);
    EXPECT_NEAR(double(s.uv.y), double(uv.y), 1e-5);
    const Vec3d n = triangle.Normal(b1, b2);
    ExpectNearVector(s.shading.n, n, 1e-5, "shading normal");
    ExpectDerivatives(triangle, b1, b2, s);
    ExpectShadingTangents(s, n, mesh.s.empty() ? Vec3d() : triangle.Blend(mesh.s, b1, b2));
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(tested, 300);
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
const Transform kTrianglePlace = Transform::Translate({1, -2, 3}) *
                                 *Transform::Rotate(35, {1, 2, -1}) * *Transform::Scale(2, 3, -1.5);

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
  const PlacedEmitter emitter(UnitDisk(plugins), kTrianglePlace);
  EXPECT_NEAR(double(emitter.Area()) / (6 * M_PI), 1, 1e-3);
  ExpectUniformEllipse(emitter, *local, kTrianglePlace, 6 * M_PI, Real(.25));
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
    ExpectNearVector(s.dpdx, x, 1e-5, "dpdx");
    ExpectNearVector(s.dpdy, y, 1e-5, "dpdy");
    ExpectNearVector((u * double(s.dudx) + v * double(s.dvdx)).ToReal(), x, 1e-4, "x by u and v");
    ExpectNearVector((u * double(s.dudy) + v * double(s.dvdy)).ToReal(), y, 1e-4, "y by u and v");
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
