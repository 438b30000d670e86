// SPDX-License-Identifier: BSD-2-Clause
// RandomScene, AwkwardRay and ShapesAndInstances make random geometry for tests. The seed alone
// determines the result.
#include "tests/support/geometry_scenes.h"

#include <gtest/gtest.h>

#include "core/geometry/vec3d.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

using Triangle = std::array<Point3, 3>;

Triangle RandomTriangle(RandomStream& random, Real extent, Real size) {
  const Point3 center = RandomVector(random) * extent;
  return {center + RandomVector(random) * size, center + RandomVector(random) * size,
          center + RandomVector(random) * size};
}

// Places vertices on a coarse grid, which gives many coplanar, touching and axis-parallel
// triangles.
Triangle SnappedTriangle(RandomStream& random) {
  Triangle triangle;
  for (Point3& p : triangle)
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::floor(Between(random, -3, 4)) / 2;
  return triangle;
}

Triangle Sliver(RandomStream& random) {
  const Point3 a = RandomVector(random), b = RandomVector(random);
  const Point3 along = a + (b - a) * random.Uniform();
  return {a, b, along + RandomVector(random) * Real(1e-6)};
}

TriangleList TrianglesOfKind(std::uint64_t kind, RandomStream& random) {
  TriangleList list;
  const int count = 2 + int(random.Uniform() * 120);
  for (int i = 0; i < count; ++i) {
    switch (kind) {
      case 0:
        list.push_back(RandomTriangle(random, 1, Real(.2)));
        break;
      case 1:
        list.push_back(RandomTriangle(random, 1, 2));
        break;
      case 2:
        list.push_back(SnappedTriangle(random));
        break;
      case 3:
        list.push_back(Sliver(random));
        break;
      case 4:  // all in one plane
        list.push_back(RandomTriangle(random, 1, 1));
        for (Point3& p : list.back()) p.y = Real(.25);
        break;
      case 5: {  // scales from 1e-4 to 1e4
        const Real size = std::pow(Real(10), Between(random, -4, 4));
        list.push_back(RandomTriangle(random, 1, size));
        break;
      }
      case 6:  // far from the origin
        list.push_back(RandomTriangle(random, 1, Real(.3)));
        for (Point3& p : list.back()) p += Vector3(Real(1e4), Real(-2e4), 500);
        break;
      case 7: {  // boxes, which share edges
        const Point3 p = RandomVector(random);
        const auto box = BoxTriangles(p, p + Abs(RandomVector(random)) * Real(.5));
        list.insert(list.end(), box.begin(), box.end());
        break;
      }
      case 8:  // identical triangles
        list.push_back(i % 3 == 0 ? RandomTriangle(random, 1, 1) : list.back());
        break;
      default:
        list.push_back(i % 2 ? SnappedTriangle(random) : RandomTriangle(random, 2, 1));
        break;
    }
  }
  return list;
}

Point3 PointOn(const Triangle& v, RandomStream& random, int where) {
  if (where == 0) return v[std::size_t(random.Uniform() * 3)];
  const Real b = random.Uniform(), c = where == 1 ? 0 : random.Uniform() * (1 - b);
  return v[0] * (1 - b - c) + v[1] * b + v[2] * c;
}

Point3 PointNear(const PrimitiveSet& set, RandomStream& random) {
  const auto id = std::uint32_t(random.Uniform() * Real(set.Count()));
  if (id >= set.TriangleCount()) {
    const Bounds3 bounds = set.Bounds(id);
    const Vector3 r = RandomVector(random);
    const Vector3 half = bounds.Diagonal() * Real(.5);
    return bounds.Center() + Vector3(half.x * r.x, half.y * r.y, half.z * r.z);
  }
  return PointOn(set.TriangleVertices(id), random, int(random.Uniform() * 3));
}

}  // namespace

Real Between(RandomStream& random, Real low, Real high) {
  return low + random.Uniform() * (high - low);
}

Vector3 RandomVector(RandomStream& random) {
  const Real x = Between(random, -1, 1), y = Between(random, -1, 1);
  return {x, y, Between(random, -1, 1)};
}

std::shared_ptr<TriangleMesh> MeshOf(const TriangleList& triangles) {
  auto mesh = std::make_shared<TriangleMesh>();
  for (const Triangle& triangle : triangles) {
    const auto first = std::uint32_t(mesh->p.size());
    mesh->p.insert(mesh->p.end(), triangle.begin(), triangle.end());
    mesh->indices.push_back({first, first + 1, first + 2});
  }
  mesh->DropDegenerate();
  return mesh;
}

std::unique_ptr<PrimitiveSet> TriangleSet(const TriangleList& triangles) {
  auto set = std::make_unique<PrimitiveSet>();
  set->AddMesh(MeshOf(triangles), {});
  set->Finish();
  return set;
}

TriangleList BoxTriangles(const Point3& min, const Point3& max) {
  const Bounds3 box(min, max);
  // Bits 0, 1 and 2 of a corner select x, y and z. Each face is counter-clockwise seen from
  // outside.
  constexpr int kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  TriangleList list;
  for (const auto& f : kFaces) {
    list.push_back({box.Corner(f[0]), box.Corner(f[1]), box.Corner(f[2])});
    list.push_back({box.Corner(f[0]), box.Corner(f[2]), box.Corner(f[3])});
  }
  return list;
}

TriangleList SphereTriangles(const Point3& center, int rings, int sectors) {
  const auto vertex = [&](int ring, int sector) {
    if (ring == 0) return center + Vector3(0, 0, 1);
    if (ring == rings) return center + Vector3(0, 0, -1);
    const double theta = 3.14159265358979 * ring / rings;
    const double phi = 6.28318530717959 * (sector % sectors) / sectors;
    return center + Vector3(Real(std::sin(theta) * std::cos(phi)),
                            Real(std::sin(theta) * std::sin(phi)), Real(std::cos(theta)));
  };
  TriangleList list;
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const Point3 a = vertex(ring, sector), b = vertex(ring + 1, sector);
      const Point3 c = vertex(ring + 1, sector + 1), d = vertex(ring, sector + 1);
      if (ring + 1 < rings) list.push_back({a, b, c});
      if (ring > 0) list.push_back({a, c, d});
    }
  }
  return list;
}

std::unique_ptr<PrimitiveSet> RandomScene(std::uint64_t seed) {
  RandomStream random(HashKey({seed, 17}));
  return TriangleSet(TrianglesOfKind(seed % 10, random));
}

Ray AwkwardRay(const PrimitiveSet& set, RandomStream& random) {
  const Bounds3 world = set.WorldBounds();
  const auto anywhere = [&] {
    const Real least = MaxComponent(world.Diagonal()) * Real(.1);  // for flat worlds
    const Vector3 r = RandomVector(random), d = Max(world.Diagonal(), Vector3(least));
    return world.Center() + Vector3(d.x * r.x, d.y * r.y, d.z * r.z);
  };
  Ray ray;
  const int kind = int(random.Uniform() * 6);
  ray.o = kind == 1 || kind == 4 ? PointNear(set, random) : anywhere();
  const Point3 target = kind == 0 ? anywhere() : PointNear(set, random);
  ray.d = target - ray.o;
  if (kind == 2 || kind == 4) {  // along an axis
    const int axis = int(random.Uniform() * 3);
    const Real length = ray.d[axis];
    if (kind == 2) ray.o = target - Vector3(), ray.o[axis] = anywhere()[axis];
    ray.d = Vector3(-Real(0), 0, -Real(0));
    ray.d[axis] = length;
  }
  if (kind == 5) {  // in a coordinate plane through the target
    const int axis = int(random.Uniform() * 3);
    ray.o[axis] = target[axis];
    ray.d[axis] = 0;
  }
  if (ray.d == Vector3()) ray.d = {0, 0, 1};
  if (random.Uniform() < Real(.5)) ray.d = NormalizeOr(ray.d, {0, 0, 1});
  if (random.Uniform() < Real(.3)) ray.tMax = random.Uniform() * 2;
  ray.time = random.Uniform();
  return ray;
}

ShapesAndInstances::ShapesAndInstances(TestPlugins& plugins, const std::string& accelerator,
                                       std::uint64_t seed) {
  RandomStream random(HashKey({seed, 99}));
  const auto transform = [&](Real extent) {
    return Transform::Translate(RandomVector(random) * extent) *
           *Transform::Rotate(double(random.Uniform()) * 360, RandomVector(random)) *
           *Transform::Scale(double(Between(random, Real(.3), 1)),
                             double(Between(random, Real(.3), 1)), 0.5);
  };
  const auto addShapes = [&](PrimitiveSet& set, int count) {
    const char* const kinds[] = {R"("sphere")",
                                 R"("disk" "float innerradius" .2)",
                                 R"("cylinder" "float phimax" 200)",
                                 R"("sphere" "float zmin" -.5 "float phimax" 300)",
                                 R"("cone" "float phimax" 250)",
                                 R"("paraboloid")",
                                 R"("hyperboloid" "point p1" [1 0 -.5] "point p2" [-.4 .9 1])"};
    for (int i = 0; i < count; ++i) {
      ShapeGeometry shape =
          plugins.MakeShape(kinds[std::size_t(i) % std::size(kinds)], transform(2));
      set.AddShape(std::move(std::get<std::unique_ptr<Shape>>(shape)), {});
    }
  };
  auto inner = std::make_unique<PrimitiveSet>();
  inner->AddMesh(MeshOf(TrianglesOfKind(seed % 10, random)), {});
  addShapes(*inner, 3);
  inner->Finish();
  auto aggregate = plugins.MakeAccelerator(accelerator, *inner);
  object_ = std::make_unique<ObjectGeometry>(std::move(inner), std::move(aggregate));

  set_.AddMesh(MeshOf(TrianglesOfKind((seed + 1) % 10, random)), {});
  addShapes(set_, 8);
  for (int i = 0; i < 6; ++i) set_.AddInstance({transform(2), object_.get()});
  // The same instance is placed twice: t is equal everywhere, and the ids decide.
  const Transform twice = transform(1);
  set_.AddInstance({twice, object_.get()});
  set_.AddInstance({twice, object_.get()});
  for (int i = 0; i < 3; ++i) {
    const char* problem = "";
    const auto motion =
        *AnimatedTransform::Between(transform(2), transform(2), {Real(.2), Real(.8)}, &problem);
    set_.AddInstance({motion.Start(), object_.get(), std::make_shared<const Motion>(motion)});
  }
  set_.Finish();
}

std::unique_ptr<PrimitiveSet> CrowdOfTriangles(TestPlugins& plugins) {
  RandomStream random(31);
  TriangleList triangles;
  for (int i = 0; i < 30000; ++i) {
    const Point3 p = Point3() + RandomVector(random) * 10;
    triangles.push_back(
        {p, p + RandomVector(random) * Real(.2), p + RandomVector(random) * Real(.2)});
  }
  auto set = std::make_unique<PrimitiveSet>();
  set->AddMesh(MeshOf(triangles), {});
  for (int i = 0; i < 600; ++i) {
    auto shape = plugins.MakeShape(R"("sphere" "float radius" .1)",
                                   Transform::Translate(RandomVector(random) * 10));
    set->AddShape(std::move(std::get<std::unique_ptr<Shape>>(shape)), {});
  }
  set->Finish();
  return set;
}

void ExpectHitsOfBruteForce(const Aggregate& tested, const PrimitiveSet& crowd,
                            TestPlugins& plugins) {
  const auto oracle = plugins.MakeAccelerator(R"("bruteforce")", crowd);
  RandomStream random(5);
  int triangles = 0, spheres = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = AwkwardRay(crowd, random);
    const Hit expected = oracle->Intersect(ray), found = tested.Intersect(ray);
    EXPECT_EQ(expected.t, found.t);
    ASSERT_EQ(expected.primitive, found.primitive) << "ray " << i;
    ASSERT_EQ(oracle->Occluded(ray), tested.Occluded(ray)) << "ray " << i;
    if (expected.IsHit()) ++(expected.primitive < crowd.TriangleCount() ? triangles : spheres);
  }
  EXPECT_GT(triangles, 100);
  EXPECT_GT(spheres, 10);
}

}  // namespace exphoton
