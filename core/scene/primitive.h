// SPDX-License-Identifier: BSD-2-Clause
// PrimitiveSet: the things that one accelerator is built over, in flat arrays, and the test of one
// ray against one of them. Ids: triangles first, then shapes, then instances.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/shape.h"
#include "core/geometry/triangle_mesh.h"
#include "core/math/motion.h"
#include "core/scattering/bxdf.h"

namespace exphoton {

class Aggregate;

inline constexpr std::uint32_t kNoId = ~std::uint32_t(0);

// The nearest hit so far, small enough to live in registers. Ties in t go to the lower instance,
// then the lower primitive id, so that every accelerator gives the same winner.
struct Hit {
  Real t = kInfinity;
  Point2 uv;  // triangle: (b1, b2); shape: ShapeHit::uv
  std::uint32_t primitive = kNoId;
  std::uint32_t instance = kNoId;  // id in the outer set, where the hit is inside an instance

  bool IsHit() const { return primitive != kNoId; }
};

// A ray with what the tests of many primitives share.
struct TraceRay {
  Ray ray;
  TriangleRay triangle;
  explicit TraceRay(const Ray& r) : ray(r), triangle(r) {}
};

struct PrimitiveAttributes {
  const Material* material = nullptr;
  const AreaLight* areaLight = nullptr;
};

// Same geometry in object space, placed by a transformation.
struct Instance {
  Transform instanceToWorld;  // where it moves: at the start
  const class ObjectGeometry* object = nullptr;
  std::shared_ptr<const Motion> motion = nullptr;  // null: it rests
};

class PrimitiveSet {
 public:
  void AddMesh(std::shared_ptr<const TriangleMesh> mesh, PrimitiveAttributes attributes);
  void AddShape(std::shared_ptr<const Shape> shape, PrimitiveAttributes attributes);
  void AddInstance(const Instance& instance);
  // Call once after the last Add: assigns ids and lays the triangles out flat.
  void Finish();

  std::uint32_t Count() const;
  std::uint32_t TriangleCount() const { return std::uint32_t(triangles_.size()); }
  // Of the true surface (of an instance: with what rounding its rays asks for). Accelerators add
  // their own margin. Empty for an instance of nothing.
  Bounds3 Bounds(std::uint32_t id) const;
  Bounds3 WorldBounds() const { return bounds_; }
  // Lobes that the materials may have: of one primitive (for an instance, of all of its object),
  // and of the whole set once it is finished.
  LobeSet PossibleLobes(std::uint32_t id) const;
  LobeSet PossibleLobes() const { return lobes_; }

  // Vertices of a triangle, for accelerators that clip.
  const std::array<Point3, 3>& TriangleVertices(std::uint32_t id) const { return vertices_[id]; }

  // Whether the ray certainly misses primitive `id`; cheap and inline, false where it is not.
  bool Misses(std::uint32_t id, const TraceRay& ray) const {
    if (id >= vertices_.size()) return false;
    const auto& v = vertices_[id];
    return MissesTriangle(ray.triangle, v[0], v[1], v[2]);
  }
  // Tests primitive `id`; replaces *hit (whose t bounds the search) where nearer, or as near with a
  // lower id. `hit->t` starts at ray.tMax.
  void Intersect(std::uint32_t id, const TraceRay& ray, Hit* hit) const;
  // The nearest of all hits as accelerators tell it: of triangles with HitInSingle where that can.
  Hit Reported(const TraceRay& ray, const Hit& nearest) const;
  // Whether primitive `id` blocks the ray in 0 < t < ray.tMax.
  bool Occludes(std::uint32_t id, const TraceRay& ray) const;

  // The full record of a hit that Intersect found with this ray.
  SurfaceInteraction Surface(const Ray& ray, const Hit& hit) const;
  // Its first part, at a fraction of the cost for triangles: the same p, pError and ng.
  SurfacePoint Point(const Ray& ray, const Hit& hit) const;
  PrimitiveAttributes Attributes(const Hit& hit) const;
  // Of what was hit; null where it rests.
  const Motion* MotionOf(const Hit& hit) const {
    return hit.instance == kNoId ? nullptr : InstanceOf(hit).motion.get();
  }
  // Whether anything is not in the same place at all times of the interval.
  bool MovesWithin(Interval interval) const;

 private:
  const Instance& InstanceOf(const Hit& hit) const {
    return instances_[hit.instance - triangles_.size() - shapes_.size()];
  }
  Bounds3 InstanceBounds(const Instance& instance) const;
  Real OrderedDistance(const Ray& ray, const Hit& hit) const;
  Ray InstanceRay(std::uint32_t instance, const Ray& ray, Real tMax) const;
  void IntersectInstance(std::uint32_t instance, const TraceRay& ray, Hit* hit) const;
  SurfaceInteraction InstanceSurface(const Ray& ray, const Hit& hit) const;

  struct Triangle {  // 8 bytes: where the vertices are
    std::uint32_t mesh, index;
  };
  std::vector<Triangle> triangles_;
  std::vector<std::array<Point3, 3>> vertices_;  // by triangle id, contiguous
  std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
  std::vector<PrimitiveAttributes> meshAttributes_;
  std::vector<std::uint8_t> meshFlips_;  // whether normals are turned round
  std::vector<std::shared_ptr<const Shape>> shapes_;
  std::vector<PrimitiveAttributes> shapeAttributes_;
  std::vector<Instance> instances_;
  std::vector<Transform> worldToInstance_;
  std::vector<Bounds3> instanceBounds_;
  Bounds3 bounds_;
  LobeSet lobes_ = LobeSet::None;
};

}  // namespace exphoton
