// SPDX-License-Identifier: BSD-2-Clause
// These functions make random geometry for tests of intersection and acceleration: sets of awkward
// triangles, shapes with instances, and rays that aim at edges, vertices and planes.
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

// Returns a finished set of these triangles, which share no vertices. Drops degenerate triangles.
std::unique_ptr<PrimitiveSet> TriangleSet(const TriangleList& triangles);
std::shared_ptr<TriangleMesh> MeshOf(const TriangleList& triangles);

// Returns the twelve triangles of a box. Their normals point outwards.
TriangleList BoxTriangles(const Point3& min, const Point3& max);
// Returns a closed mesh of a unit sphere about the centre. It has `rings` by `sectors` quads, whose
// common vertices are equal bit for bit.
TriangleList SphereTriangles(const Point3& center, int rings, int sectors);

// Returns a scene of one of several kinds, chosen by the seed.
std::unique_ptr<PrimitiveSet> RandomScene(std::uint64_t seed);

// Returns a ray near the set: random, along an axis with zeros of either sign, from or to vertices
// and edges, or in the plane of a triangle. Some rays have a finite tMax.
Ray AwkwardRay(const PrimitiveSet& set, RandomStream& random);

// ShapesAndInstances is a set of triangles, spheres, disks, cylinders and instances of such a set.
class ShapesAndInstances {
 public:
  ShapesAndInstances(TestPlugins& plugins, const std::string& accelerator, std::uint64_t seed);
  const PrimitiveSet& Set() const { return set_; }

 private:
  std::unique_ptr<ObjectGeometry> object_;
  PrimitiveSet set_;
};

// Returns 30,000 small triangles and 600 spheres, far more than one task of a parallel build.
std::unique_ptr<PrimitiveSet> CrowdOfTriangles(TestPlugins& plugins);
// Fails the test if an accelerator over such a set answers an awkward ray differently from brute
// force.
void ExpectHitsOfBruteForce(const Aggregate& tested, const PrimitiveSet& crowd,
                            TestPlugins& plugins);

Real Between(RandomStream& random, Real low, Real high);
Vector3 RandomVector(RandomStream& random);  // components in [-1, 1)

}  // namespace exphoton
