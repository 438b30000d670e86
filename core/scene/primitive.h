// SPDX-License-Identifier: BSD-2-Clause
// PrimitiveSet stores the primitives of one accelerator in flat arrays and intersects a ray with
// one primitive. Ids are assigned to triangles first, then to shapes, then to instances.
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

// The nearest hit so far, small enough to stay in registers. Ties in t go to the lower instance,
// then to the lower primitive id, so that all accelerators find the same hit.
struct Hit {
  Real t = kInfinity;
  Point2 uv;  // triangle: (b1, b2); shape: ShapeHit::uv
  std::uint32_t primitive = kNoId;
  std::uint32_t instance = kNoId;  // id in the outer set if the hit is inside an instance

  bool IsHit() const { return primitive != kNoId; }
};

// A ray with precomputed values that the tests of many primitives share.
struct TraceRay {
  Ray ray;
  TriangleRay triangle;
  explicit TraceRay(const Ray& r) : ray(r), triangle(r) {}
};

struct PrimitiveAttributes {
  const Material* material = nullptr;
  const AreaLight* areaLight = nullptr;
  std::uint32_t objectId = 0, materialId = 0;  // see SurfaceInteraction
};

// An object's geometry, placed in the world by a transformation.
struct Instance {
  Transform instanceToWorld;  // if it moves: at the start of the motion
  const class ObjectGeometry* object = nullptr;
  std::shared_ptr<const Motion> motion = nullptr;  // null: the instance does not move
  std::uint32_t objectId = 0;                      // 0: its shapes have their own
};

class PrimitiveSet {
 public:
  // The triangles of a mesh with alpha become shapes.
  void AddMesh(std::shared_ptr<const TriangleMesh> mesh, PrimitiveAttributes attributes);
  void AddShape(std::shared_ptr<const Shape> shape, PrimitiveAttributes attributes);
  void AddInstance(const Instance& instance);
  // Assigns ids and builds the flat triangle arrays. Must be called once, after the last Add.
  void Finish();

  std::uint32_t Count() const;
  std::uint32_t TriangleCount() const { return std::uint32_t(triangles_.size()); }
  // Returns the bounds of the exact surface. The bounds of an instance include a margin for the
  // rounding of transformed rays. Accelerators add their own margin. An instance without primitives
  // has empty bounds.
  Bounds3 Bounds(std::uint32_t id) const;
  Bounds3 WorldBounds() const { return bounds_; }
  // Returns the lobes that the materials may have: of one primitive, or of the whole set after
  // Finish. The lobes of an instance are those of its whole object.
  LobeSet PossibleLobes(std::uint32_t id) const;
  LobeSet PossibleLobes() const { return lobes_; }
  // Returns whether any material of the set needs ray differentials, after Finish.
  bool NeedsDifferentials() const { return needsDifferentials_; }

  // The vertices of a triangle, for accelerators that store triangles in their own layout.
  const std::array<Point3, 3>& TriangleVertices(std::uint32_t id) const { return vertices_[id]; }

  // Returns true if the ray certainly misses primitive `id`. The test is cheap and inline. It
  // returns false if the full test is needed.
  bool Misses(std::uint32_t id, const TraceRay& ray) const {
    if (id >= vertices_.size()) return false;
    const auto& v = vertices_[id];
    return MissesTriangle(ray.triangle, v[0], v[1], v[2]);
  }
  // Intersects primitive `id`. Replaces *hit if the new hit is nearer, or equally near with a lower
  // id. hit->t bounds the search and starts at ray.tMax.
  void Intersect(std::uint32_t id, const TraceRay& ray, Hit* hit) const;
  // Returns the nearest hit in its final form, as accelerators report it. A triangle hit gets the t
  // and uv of the single-precision test (HitInSingle) if that test can guarantee its accuracy.
  Hit Reported(const TraceRay& ray, const Hit& nearest) const;
  // Returns whether primitive `id` blocks the ray in 0 < t < ray.tMax.
  bool Occludes(std::uint32_t id, const TraceRay& ray) const;

  // Returns the full surface record of a hit that Intersect found with this ray.
  SurfaceInteraction Surface(const Ray& ray, const Hit& hit) const;
  // Returns the same p, pError and ng as Surface. For triangles, it costs a fraction of Surface.
  SurfacePoint Point(const Ray& ray, const Hit& hit) const;
  PrimitiveAttributes Attributes(const Hit& hit) const;
  // Returns the motion of the primitive that was hit; null if it does not move.
  const Motion* MotionOf(const Hit& hit) const {
    return hit.instance == kNoId ? nullptr : InstanceOf(hit).motion.get();
  }
  // Returns whether any primitive moves during the interval.
  bool MovesWithin(Interval interval) const;
  // Returns the bounds of the instances that move during the interval and emit light.
  std::vector<Bounds3> MovingEmitters(Interval interval) const;

 private:
  const Instance& InstanceOf(const Hit& hit) const {
    return instances_[hit.instance - triangles_.size() - shapes_.size()];
  }
  Bounds3 InstanceBounds(const Instance& instance) const;
  void FindTraitsOfMaterials();
  bool EmitsLight() const;  // whether any triangle or shape does
  Real OrderedDistance(const Ray& ray, const Hit& hit) const;
  Ray InstanceRay(std::uint32_t instance, const Ray& ray, Real tMax) const;
  void IntersectInstance(std::uint32_t instance, const TraceRay& ray, Hit* hit) const;
  SurfaceInteraction InstanceSurface(const Ray& ray, const Hit& hit) const;

  struct Triangle {  // 8 bytes; locates the vertices
    std::uint32_t mesh, index;
  };
  std::vector<Triangle> triangles_;
  std::vector<std::array<Point3, 3>> vertices_;  // by triangle id, contiguous
  std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
  std::vector<PrimitiveAttributes> meshAttributes_;
  std::vector<std::uint8_t> meshFlips_;  // per mesh: whether normals are flipped
  std::vector<std::shared_ptr<const Shape>> shapes_;
  std::vector<PrimitiveAttributes> shapeAttributes_;
  std::vector<Instance> instances_;
  std::vector<Transform> worldToInstance_;
  std::vector<Bounds3> instanceBounds_;
  Bounds3 bounds_;
  LobeSet lobes_ = LobeSet::None;
  bool needsDifferentials_ = false;
};

}  // namespace exphoton
