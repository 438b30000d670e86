// SPDX-License-Identifier: BSD-2-Clause
// These tests compare the surface of an instance with the surface of a shape that is created
// under the instance's transformation. Under non-uniform scales, normals transform differently
// from vectors.
#include <gtest/gtest.h>

#include "core/geometry/placement.h"
#include "tests/support/geometry_scenes.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

const Transform kPlace = Transform::Translate({1, -2, 3}) * *Transform::Scale(1, 2, 4) *
                         *Transform::Rotate(35, {1, 2, -1});

void Add(PrimitiveSet* set, ShapeGeometry geometry) {
  if (auto* shape = std::get_if<std::unique_ptr<Shape>>(&geometry)) {
    set->AddShape(std::move(*shape), {});
  } else {
    set->AddMesh(std::move(std::get<std::unique_ptr<TriangleMesh>>(geometry)), {});
  }
  set->Finish();
}

// Both holds a shape as an instance, and the same shape created under the instance's
// transformation.
class Both {
 public:
  explicit Both(const std::string& text) {
    auto inner = std::make_unique<PrimitiveSet>();
    Add(inner.get(), plugins_.MakeShape(text));
    auto aggregate = plugins_.MakeAccelerator(R"("bruteforce")", *inner);
    object_ = std::make_unique<ObjectGeometry>(std::move(inner), std::move(aggregate));
    instance_.AddInstance({kPlace, object_.get()});
    instance_.Finish();
    Add(&direct_, plugins_.MakeShape(text, kPlace));
    byInstance_ = plugins_.MakeAccelerator(R"("bruteforce")", instance_);
    byShape_ = plugins_.MakeAccelerator(R"("bruteforce")", direct_);
  }

  struct Surfaces {
    SurfaceInteraction found, expected;
  };
  // Returns both surfaces where the ray from o to `target` hits them. The points are in the
  // shape's space.
  std::optional<Surfaces> Meet(const Point3& o, const Point3& target) const {
    Ray ray;
    ray.o = kPlace.ApplyPoint(o);
    ray.d = kPlace.ApplyPoint(target) - ray.o;
    const Hit a = byInstance_->Intersect(ray), b = byShape_->Intersect(ray);
    if (!a.IsHit() || !b.IsHit()) return std::nullopt;
    return Surfaces{instance_.Surface(ray, a), direct_.Surface(ray, b)};
  }

 private:
  TestPlugins plugins_;
  std::unique_ptr<ObjectGeometry> object_;
  PrimitiveSet instance_, direct_;
  std::unique_ptr<Aggregate> byInstance_, byShape_;
};

void ExpectNear(const Vec3& a, const Vec3& b, const char* what) {
  EXPECT_LT(Length(a - b), Real(2e-5) * (1 + Length(b))) << what;
}

TEST(InstanceSurface, OfASphereIsTheSurfaceOfTheScaledSphere) {
  const Both sphere(R"("sphere")");
  RandomStream random(4);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Point3 o = Point3() + RandomVector(random) * 5;
    const auto met = sphere.Meet(o, Point3() + RandomVector(random) * Real(.4));
    if (!met) continue;
    ++hits;
    ExpectNear(met->found.ng, met->expected.ng, "ng");
    ExpectNear(met->found.dpdu, met->expected.dpdu, "dpdu");
    ExpectNear(met->found.dpdv, met->expected.dpdv, "dpdv");
    ExpectNear(met->found.dndu, met->expected.dndu, "dndu");
    ExpectNear(met->found.dndv, met->expected.dndv, "dndv");
    ExpectNear(met->found.shading.n, met->expected.shading.n, "shading.n");
    ExpectNear(met->found.shading.dpdu, met->expected.shading.dpdu, "shading.dpdu");
    ExpectNear(met->found.shading.dpdv, met->expected.shading.dpdv, "shading.dpdv");
    ExpectNear(met->found.shading.dndu, met->expected.shading.dndu, "shading.dndu");
    ExpectNear(met->found.shading.dndv, met->expected.shading.dndv, "shading.dndv");
    if (HasFailure()) FAIL() << "ray " << i;
  }
  EXPECT_GT(hits, 100);
}

// A transformation maps the parallelogram of two tangents to another parallelogram.
TEST(AreaScale, IsTheRatioOfTheAreasOfAParallelogram) {
  RandomStream random(5);
  for (int i = 0; i < 100; ++i) {
    const Frame frame = Frame::FromZ(NormalizeOr(RandomVector(random), {0, 0, 1}));
    const Vector3 image = Cross(kPlace.ApplyVector(frame.x), kPlace.ApplyVector(frame.y));
    EXPECT_NEAR(double(AreaScale(kPlace, frame.z) / Length(image)), 1, 1e-5);
  }
}

// Two small steps a and b across a direction w span the solid angle det(w, a, b) / |w|^3.
TEST(SolidAngleScale, IsTheRatioOfSmallSolidAngles) {
  RandomStream random(6);
  const Transform toLocal = kPlace.Inverted();
  for (int i = 0; i < 100; ++i) {
    const Frame frame = Frame::FromZ(NormalizeOr(RandomVector(random), {0, 0, 1}));
    const Vector3 w = toLocal.ApplyVector(frame.z);
    const Vector3 across = Cross(toLocal.ApplyVector(frame.x), toLocal.ApplyVector(frame.y));
    const double length = double(Length(w));
    const double expected = std::abs(double(Dot(w, across))) / (length * length * length);
    EXPECT_NEAR(double(SolidAngleScale(kPlace, frame.z)) / expected, 1, 1e-4);
  }
}

TEST(Trianglemesh, TangentsAreStretchedAsTheSurfaceIs) {
  TestPlugins plugins;
  ShapeGeometry geometry = plugins.MakeShape(R"("trianglemesh" "integer indices" [0 1 2]
      "point P" [0 0 0 1 0 0 0 1 0] "vector S" [1 1 0 1 1 0 1 1 0])",
                                             *Transform::Scale(1, 3, 1));
  const auto& mesh = *std::get<std::unique_ptr<TriangleMesh>>(geometry);
  const Vector3 tangent = Normalize(TriangleSurface(mesh, 0, 0, 0).shading.dpdu);
  EXPECT_LT(Distance(tangent, Normalize(Vector3(1, 3, 0))), Real(1e-6));
}

// A tangent of the file on one diagonal, the other tangent on the other diagonal; both turned by a
// quarter and doubled.
TEST(InstanceSurface, OfAMeshHasTheTangentsOfTheFile) {
  TriangleMesh mesh;
  mesh.p = {Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, 1, 0)};
  mesh.uv = {{0, 0}, {1, 0}, {0, 1}};
  mesh.indices = {{0, 1, 2}};
  mesh.s.assign(3, Vector3(1, 1, 0));
  const Transform place = *Transform::Scale(2, 2, 2) * *Transform::Rotate(90, {0, 0, 1});
  const SurfaceInteraction surface =
      SurfaceToWorld(place, TriangleSurface(mesh, 0, Real(.25), Real(.25)));
  const Real side = std::sqrt(Real(2));
  ExpectNear(surface.shading.dpdu, {-side, side, 0}, "shading.dpdu");
  ExpectNear(surface.shading.dpdv, {-side, -side, 0}, "shading.dpdv");
  ExpectNear(surface.dpdu, {0, 2, 0}, "dpdu");
  ExpectNear(surface.dpdv, {-2, 0, 0}, "dpdv");
}

// The surfaces are compared at vertices. Between vertices, they interpolate normals of
// different lengths.
TEST(InstanceSurface, OfAMeshHasTheScaledNormalsAtItsVertices) {
  const Both mesh(
      R"("trianglemesh" "integer indices" [0 1 2] "point P" [-1 -1 0 1 -1 0 1 1 .3]
         "normal N" [-.4 -.3 1 .4 -.3 1 .4 .3 1])");
  const Point3 middle(Real(.3), Real(-.3), Real(.1));
  for (const Point3& vertex : {Point3(-1, -1, 0), Point3(1, -1, 0), Point3(1, 1, Real(.3))}) {
    const auto met = mesh.Meet({0, 0, 5}, vertex + (middle - vertex) * Real(1e-4));
    ASSERT_TRUE(met);
    ExpectNear(met->found.ng, met->expected.ng, "ng");
    EXPECT_LT(Distance(met->found.shading.n, met->expected.shading.n), Real(1e-3));
    EXPECT_GT(Distance(met->found.shading.n, met->found.ng), Real(.1));
  }
}

// A stretch by 10 along z takes the interpolated normals to the other side of this triangle.
TriangleMesh MeshWithTurnedNormals() {
  TriangleMesh mesh;
  mesh.p = {Point3(0, 0, 0), Point3(1, 0, 0), Point3(0, Real(.8), Real(-.6))};
  mesh.uv = {{0, 0}, {1, 0}, {0, 1}};
  mesh.indices = {{0, 1, 2}};
  mesh.n = {Normal3(0, Real(-.5), Real(.9)), Normal3(Real(.2), Real(-.5), Real(.9)),
            Normal3(0, Real(-.4), Real(.9))};
  return mesh;
}

// The normals are turned back, and their derivatives are the differences of the turned normals.
TEST(InstanceSurface, OfAMeshTurnsDerivativesWithItsNormals) {
  const TriangleMesh mesh = MeshWithTurnedNormals();
  const Transform place = *Transform::Scale(1, 1, 10);
  const auto at = [&](Real u, Real v) {
    return SurfaceToWorld(place, TriangleSurface(mesh, 0, u, v));
  };
  const Real h = Real(1) / 64;
  const SurfaceInteraction surface = at(Real(.25), Real(.25));
  EXPECT_LT(Dot(place.ApplyNormal(mesh.n[0]), surface.ng), 0);
  EXPECT_GT(Dot(surface.shading.n, surface.ng), 0);
  const Vector3 du =
      at(Real(.25) + h, Real(.25)).shading.n - at(Real(.25) - h, Real(.25)).shading.n;
  const Vector3 dv =
      at(Real(.25), Real(.25) + h).shading.n - at(Real(.25), Real(.25) - h).shading.n;
  EXPECT_LT(Distance(surface.shading.dndu, du / (2 * h)), Real(1e-3));
  EXPECT_LT(Distance(surface.shading.dndv, dv / (2 * h)), Real(1e-3));
  EXPECT_GT(Length(surface.shading.dndu), Real(.05));
}

TEST(InstanceSurface, OfAMeshKeepsTheHandOfTangentsWhereItTurnsNormals) {
  const TriangleMesh mesh = MeshWithTurnedNormals();
  for (const Real mirror : {Real(1), Real(-1)}) {
    const SurfaceInteraction surface = SurfaceToWorld(
        *Transform::Scale(mirror, 1, 10), TriangleSurface(mesh, 0, Real(.25), Real(.25)));
    const auto& shading = surface.shading;
    const Real hand = Dot(Cross(surface.dpdu, surface.dpdv), surface.ng);
    EXPECT_GT(Dot(Cross(shading.dpdu, shading.dpdv), shading.n) * hand, 0) << mirror;
    EXPECT_NEAR(Dot(shading.dpdu, shading.n), 0, 1e-5);
    EXPECT_NEAR(Dot(shading.dpdv, shading.n), 0, 1e-5);
    EXPECT_NEAR(Length(shading.dpdv) / Length(surface.dpdv), 1, 1e-5);
  }
}

}  // namespace
}  // namespace exphoton
