// SPDX-License-Identifier: BSD-2-Clause
// These tests check triangles. They must be watertight, must not be hit by a ray that leaves them,
// and must behave equally at every scale. Degenerate texture coordinates, normals or tangents must
// give plain geometry.
#include <gtest/gtest.h>

#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

std::array<Point3, 3> RandomTriangle(RandomStream& random, Real scale) {
  std::array<Point3, 3> v;
  const Vector3 shift = RandomVector(random) * scale;
  for (Point3& p : v) p = shift + RandomVector(random) * (scale * random.Uniform());
  return v;
}

SurfaceInteraction PointOn(const TriangleMesh& mesh, RandomStream& random) {
  const Real b1 = random.Uniform(), b2 = random.Uniform() * (1 - b1);
  return TriangleSurface(mesh, 0, b1, b2);
}

Ray Scaled(const Ray& ray, Real factor) {
  Ray scaled = ray;
  scaled.o = ray.o * factor;
  return scaled;
}

TEST(Triangle, ClosedMeshIsWatertightWhereverItIs) {
  TestPlugins plugins;
  constexpr int kRays = 60000;
  for (const Real offset : {Real(0), Real(100), Real(1e4), Real(1e6)}) {
    const Point3 center(offset, -offset, offset / 2);
    const TriangleList triangles = SphereTriangles(center, 64, 64);
    const auto set = TriangleSet(triangles);
    const auto tree = plugins.MakeAccelerator(R"("kdtree")", *set);
    RandomStream random(5);
    int misses = 0;
    for (int i = 0; i < kRays; ++i) {
      Ray ray;
      ray.o = center + RandomVector(random) * Real(.3);
      const auto& v = triangles[std::size_t(random.Uniform() * Real(triangles.size()))];
      const int kind = i % 4;
      const Real u = random.Uniform();
      Point3 target = v[0];
      if (kind == 1) target = v[0] * (1 - u) + v[1] * u;
      if (kind > 1) target = center + RandomVector(random);
      ray.d = target - ray.o;
      misses += ray.d != Vector3() && !tree->Intersect(ray).IsHit();
    }
    EXPECT_LE(misses, offset <= Real(1e4) ? 0 : 1) << "offset " << offset;
  }
}

TEST(Triangle, IsNeverHitByARayThatLeavesIt) {
  RandomStream random(11);
  int hits = 0, tests = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto v = RandomTriangle(random, std::pow(Real(10), Between(random, -8, 8)));
    const auto mesh = MeshOf({v});
    if (mesh->TriangleCount() == 0) continue;
    for (int k = 0; k < 100; ++k) {
      const SurfaceInteraction point = PointOn(*mesh, random);
      Vector3 w = RandomVector(random);
      if (k % 4 == 0) w = w - point.ng * Dot(point.ng, w) * Real(.99999);  // grazing
      const Ray ray = SpawnRay(point, w);
      hits += IntersectTriangle(TriangleRay(ray), kInfinity, v[0], v[1], v[2]).has_value();
      ++tests;
    }
  }
  EXPECT_EQ(hits, 0) << "of " << tests;
}

TEST(Triangle, DoesNotBlockTheSegmentBetweenTwoTriangles) {
  RandomStream random(12);
  int blocked = 0, tests = 0;
  for (int i = 0; i < 1000; ++i) {
    const Real scale = std::pow(Real(10), Between(random, -6, 6));
    const auto a = RandomTriangle(random, scale);
    const auto b = RandomTriangle(random, scale * std::pow(Real(10), Between(random, -3, 3)));
    const auto meshA = MeshOf({a}), meshB = MeshOf({b});
    if (meshA->TriangleCount() + meshB->TriangleCount() < 2) continue;
    for (int k = 0; k < 20; ++k) {
      const SurfaceInteraction from = PointOn(*meshA, random), to = PointOn(*meshB, random);
      const Vector3 between = NormalizeOr(to.p - from.p, Vector3());
      if (std::min(AbsDot(between, from.ng), AbsDot(between, to.ng)) < Real(.01)) continue;
      const Ray ray = SpawnRayTo(from, to);
      const TriangleRay test(ray);
      blocked += IntersectTriangle(test, ray.tMax, a[0], a[1], a[2]).has_value();
      blocked += IntersectTriangle(test, ray.tMax, b[0], b[1], b[2]).has_value();
      ++tests;
    }
  }
  EXPECT_EQ(blocked, 0) << "of " << tests;
  EXPECT_GT(tests, 10000);
}

TEST(Triangle, ScalesByPowersOfTwoBitForBit) {
  RandomStream random(13);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto v = RandomTriangle(random, 1);
    Ray ray;
    ray.o = RandomVector(random) * 2;
    ray.d = NormalizeOr(v[0] * Real(.4) + v[1] * Real(.3) + v[2] * Real(.3) - ray.o, {0, 0, 1});
    const auto hit = IntersectTriangle(TriangleRay(ray), kInfinity, v[0], v[1], v[2]);
    for (const int k : {-20, -10, 10, 20}) {
      const Real factor = std::ldexp(Real(1), k);
      const auto scaled = IntersectTriangle(TriangleRay(Scaled(ray, factor)), kInfinity,
                                            v[0] * factor, v[1] * factor, v[2] * factor);
      ASSERT_EQ(hit.has_value(), scaled.has_value());
      if (!hit) continue;
      ++hits;
      EXPECT_EQ(hit->t * factor, scaled->t);
      EXPECT_EQ(hit->b1, scaled->b1);
      const auto mesh = MeshOf({v}),
                 larger = MeshOf({{v[0] * factor, v[1] * factor, v[2] * factor}});
      if (mesh->TriangleCount() == 0) continue;
      const SurfaceInteraction s = TriangleSurface(*mesh, 0, hit->b1, hit->b2);
      const SurfaceInteraction l = TriangleSurface(*larger, 0, scaled->b1, scaled->b2);
      EXPECT_EQ(s.p * factor, l.p);
      EXPECT_EQ(s.pError * factor, l.pError);
      EXPECT_EQ(s.ng, l.ng);
      EXPECT_EQ(s.dpdu * factor, l.dpdu);
      const Vector3 w = RandomVector(random);
      EXPECT_EQ(SpawnRay(s, w).o * factor, SpawnRay(l, w).o);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(Triangle, HitsAgreeWithExactBarycentrics) {
  RandomStream random(14);
  for (int i = 0; i < 2000; ++i) {
    const auto v = RandomTriangle(random, 1);
    const Real b1 = Between(random, Real(.1), Real(.5)), b2 = Between(random, Real(.1), Real(.4));
    const Point3 target = v[0] * (1 - b1 - b2) + v[1] * b1 + v[2] * b2;
    Ray ray;
    ray.o = target + NormalizeOr(RandomVector(random), {0, 0, 1});
    ray.d = target - ray.o;
    const auto mesh = MeshOf({v});
    if (mesh->TriangleCount() == 0) continue;
    const Vector3 cross = Cross(v[1] - v[0], v[2] - v[0]);
    const Vector3 n = NormalizeOr(cross, {0, 0, 1});
    if (Length(cross) < Real(1e-2) || AbsDot(n, ray.d) < Real(.1)) continue;
    const auto hit = IntersectTriangle(TriangleRay(ray), kInfinity, v[0], v[1], v[2]);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, 1, 1e-5);
    EXPECT_NEAR(hit->b1, b1, 1e-4);
    EXPECT_NEAR(hit->b2, b2, 1e-4);
  }
}

TEST(Triangle, OutsideFollowsTheWindingAlsoWithVertexNormals) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)}});
  EXPECT_EQ(TriangleSurface(*mesh, 0, Real(.2), Real(.2)).ng, Normal3(0, 0, 1));
  mesh->flipNormal = true;
  EXPECT_EQ(TriangleSurface(*mesh, 0, Real(.2), Real(.2)).ng, Normal3(0, 0, -1));
  mesh->n.assign(3, NormalizeOr({Real(.1), 0, 1}, {}));
  const SurfaceInteraction surface = TriangleSurface(*mesh, 0, Real(.2), Real(.2));
  EXPECT_EQ(surface.ng, Normal3(0, 0, -1));
  EXPECT_LT(surface.shading.n.z, 0);
  EXPECT_NEAR(surface.shading.n.x, -.0995, 1e-3);
}

// The vertex normals point outwards or inwards, with and without a flipped orientation.
TEST(Triangle, DerivativesOfTheNormalAgreeWithDifferences) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(2, 0, 0), Point3(0, 1, 0)}});
  mesh->uv = {{0, 0}, {1, Real(.2)}, {Real(.1), 1}};
  for (const Real side : {Real(1), Real(-1)}) {
    mesh->n = {Normal3(0, 0, 1) * side, NormalizeOr({Real(.6), 0, 1}, {}) * side,
               NormalizeOr({Real(.2), Real(.7), 1}, {}) * side};
    for (const bool flip : {false, true}) {
      mesh->flipNormal = flip;
      const Real e = Real(.002), b1 = Real(.3), b2 = Real(.4);
      const SurfaceInteraction s = TriangleSurface(*mesh, 0, b1, b2);
      EXPECT_GT(Dot(s.shading.n, s.ng), Real(.5));
      EXPECT_GT(Length(s.shading.dndu), Real(.3));
      for (const SurfaceInteraction& other :
           {TriangleSurface(*mesh, 0, b1 + e, b2), TriangleSurface(*mesh, 0, b1, b2 + e)}) {
        const Vector3 change =
            s.shading.dndu * (other.uv.x - s.uv.x) + s.shading.dndv * (other.uv.y - s.uv.y);
        EXPECT_LT(Distance(other.shading.n - s.shading.n, change), Real(.01) * Length(change))
            << side << " " << flip;
      }
    }
  }
}

// With a tangent of the file, too, the second one goes where v grows.
TEST(Triangle, ShadingTangentsKeepTheSideOfTheTextureCoordinates) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)}});
  mesh->s.assign(3, Vector3(1, 0, 0));
  for (const Real side : {Real(1), Real(-1)}) {
    mesh->uv = {{0, 0}, {1, 0}, {0, side}};
    const SurfaceInteraction surface = TriangleSurface(*mesh, 0, Real(.25), Real(.5));
    EXPECT_EQ(surface.shading.dpdu, Vector3(1, 0, 0));
    EXPECT_EQ(surface.shading.dpdv, Vector3(0, side, 0));
  }
}

TEST(Triangle, DefaultTextureCoordinatesAreThoseOfVersion1) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(1, 0, 0), Point3(1, 1, 0)}});
  const SurfaceInteraction surface = TriangleSurface(*mesh, 0, Real(.25), Real(.5));
  EXPECT_EQ(surface.uv, Point2(Real(.75), Real(.5)));
  EXPECT_EQ(surface.dpdu, Vector3(1, 0, 0));
  EXPECT_EQ(surface.dpdv, Vector3(0, 1, 0));
}

TEST(Triangle, OppositeNormalsAndTangentsAlongTheNormalFallBackToPlainGeometry) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)}});
  mesh->n = {Normal3(0, 1, 0), Normal3(0, -1, 0), Normal3(0, 0, 1)};
  mesh->s.assign(3, Vector3(0, 0, 1));
  const SurfaceInteraction cancelled = TriangleSurface(*mesh, 0, Real(.5), 0);
  EXPECT_EQ(cancelled.shading.n, cancelled.ng);
  EXPECT_TRUE(IsFinite(cancelled.shading.dpdu) && IsFinite(cancelled.shading.dpdv));
  EXPECT_GT(Length(Cross(cancelled.shading.dpdu, cancelled.shading.dpdv)), Real(.1));
  mesh->n.assign(3, Normal3());
  EXPECT_EQ(TriangleSurface(*mesh, 0, Real(.2), Real(.2)).shading.n, Normal3(0, 0, 1));
}

TEST(Triangle, UselessTextureCoordinatesGiveAFrameRoundTheNormal) {
  const auto mesh = MeshOf({{Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)}});
  for (const auto& uv : {std::vector<Point2>(3, Point2(Real(.5), Real(.5))),
                         std::vector<Point2>{{0, 0}, {1, 1}, {2, 2}}}) {
    mesh->uv = uv;
    const SurfaceInteraction surface = TriangleSurface(*mesh, 0, Real(.2), Real(.2));
    EXPECT_NEAR(Dot(surface.dpdu, surface.ng), 0, 1e-6);
    EXPECT_GT(Length(Cross(surface.dpdu, surface.dpdv)), Real(.1));
  }
  // Small texture coordinates are still valid.
  mesh->uv = {{0, 0}, {Real(1e-8), 0}, {0, Real(1e-8)}};
  EXPECT_NEAR(TriangleSurface(*mesh, 0, Real(.2), Real(.2)).dpdu.x, 1e8, 1e2);
}

TEST(Triangle, DegenerateOnesAreDroppedAtAnyScale) {
  for (const Real scale : {Real(1e-15), Real(1), Real(1e15)}) {
    const Point3 a(0, 0, 0), b(scale, 0, 0), c(0, scale, 0);
    TriangleMesh mesh;
    mesh.p = {a, b, c, b * Real(.5)};
    mesh.indices = {{0, 1, 2}, {0, 1, 1}, {0, 1, 3}, {2, 2, 2}};
    EXPECT_EQ(mesh.DropDegenerate(), 3u);
    EXPECT_EQ(mesh.TriangleCount(), 1u);
    const Normal3 n = TriangleSurface(mesh, 0, 0, 0).ng;
#ifdef EXPHOTON_DOUBLE  // rounding of the normal's length costs one ulp
    EXPECT_EQ(n.x, 0);
    EXPECT_EQ(n.y, 0);
    EXPECT_NEAR(n.z, 1, kMachineEpsilon);
#else
    EXPECT_EQ(n, Normal3(0, 0, 1));
#endif
  }
}

TEST(SurfaceInteraction, DifferentialsAreThoseOfTheTangentPlane) {
  const auto mesh = MeshOf({{Point3(0, 0, 2), Point3(1, 0, 2), Point3(1, 1, 2)}});
  SurfaceInteraction surface = TriangleSurface(*mesh, 0, Real(.3), Real(.3));
  RayDifferential ray;
  ray.o = surface.p - Vector3(0, 0, 2);
  ray.d = {0, 0, 1};
  ray.hasDifferentials = true;
  ray.xOrigin = ray.yOrigin = ray.o;
  ray.xDirection = {Real(.01), 0, 1};
  ray.yDirection = {0, Real(.02), 1};
  surface.ComputeDifferentials(ray);
  EXPECT_TRUE(surface.hasDifferentials);
  EXPECT_NEAR(surface.dpdx.x, .02, 1e-6);
  EXPECT_NEAR(surface.dudx, .02, 1e-6);
  EXPECT_NEAR(surface.dvdx, 0, 1e-6);
  EXPECT_NEAR(surface.dvdy, .04, 1e-6);

  ray.xDirection = {1, 0, 0};  // parallel to the plane, so the footprint is unknown
  surface.ComputeDifferentials(ray);
  EXPECT_FALSE(surface.hasDifferentials);
  EXPECT_EQ(surface.dpdy, Vector3());
  EXPECT_EQ(surface.dvdy, 0);
}

}  // namespace
}  // namespace exphoton
