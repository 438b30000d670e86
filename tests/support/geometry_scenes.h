// SPDX-License-Identifier: BSD-2-Clause
// Random geometry for tests of intersection and acceleration: sets of triangles with all that is
// awkward, shapes with instances, and rays that aim at edges, vertices and planes.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/math/sampling/random.h"
#include "core/scene/aggregate.h"
#include "core/scene/primitive.h"

namespace exphoton {

class TestPlugins;

using TriangleList = std::vector<std::array<Point3, 3>>;

// A finished set of these triangles, each with vertices of its own; degenerate ones are dropped.
std::unique_ptr<PrimitiveSet> TriangleSet(const TriangleList& triangles);
std::shared_ptr<TriangleMesh> MeshOf(const TriangleList& triangles);

// The twelve triangles of a box, outside outwards.
TriangleList BoxTriangles(const Point3& min, const Point3& max);
// A closed mesh of a unit sphere about the centre: `rings` by `sectors` quads, vertices shared bit
// for bit.
TriangleList SphereTriangles(const Point3& center, int rings, int sectors);

// One of several kinds of scene, chosen by the seed.
std::unique_ptr<PrimitiveSet> RandomScene(std::uint64_t seed);

// A ray about the set: random, along an axis with zeros of either sign, from or to vertices and
// edges, in the plane of a triangle; sometimes with an end.
Ray AwkwardRay(const PrimitiveSet& set, RandomStream& random);

// Triangles, spheres, disks and cylinders, and instances of such a set.
class ShapesAndInstances {
 public:
  ShapesAndInstances(TestPlugins& plugins, const std::string& accelerator, std::uint64_t seed);
  const PrimitiveSet& Set() const { return set_; }

 private:
  std::unique_ptr<ObjectGeometry> object_;
  PrimitiveSet set_;
};

// A crowd of 30,000 small triangles with spheres among them, far more than one piece of building.
std::unique_ptr<PrimitiveSet> CrowdOfTriangles(TestPlugins& plugins);
// Fails the test where an accelerator over such a crowd answers an awkward ray otherwise than brute
// force does.
void ExpectHitsOfBruteForce(const Aggregate& tested, const PrimitiveSet& crowd,
                            TestPlugins& plugins);

Real Between(RandomStream& random, Real low, Real high);
Vector3 RandomVector(RandomStream& random);  // components in [-1, 1)

}  // namespace exphoton
