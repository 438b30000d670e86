// SPDX-License-Identifier: BSD-2-Clause
// Shape: the interface of everything that is not a triangle (quadrics and the like), and
// EmitterSurface: what an area light needs to know of the surface that it lies on. All in world
// space. Triangle meshes are plain arrays (triangle_mesh.h), not Shapes.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "core/geometry/interaction.h"
#include "core/math/bounds.h"

namespace exphoton {

struct ShapeHit {
  Real t;     // 0 < t < tMax, beyond its own error bound
  Point2 uv;  // whatever two numbers the shape wants back in Surface()
};

struct EmitterSample {
  SurfacePoint point;
  Point2 uv;
  Real pdf;  // per area for SamplePoint, per solid angle at the reference for SampleToward; > 0
};

// A surface that can be sampled. Direction arguments are unit. Points that it is asked about or
// makes belong to one time, that of the reference; only of surfaces that move does it matter.
class EmitterSurface {
 public:
  virtual ~EmitterSurface() = default;

  // Area of the surface; about the mean of one whose area changes. May be slow: ask once.
  virtual Real Area() const = 0;
  virtual Bounds3 Bounds() const = 0;  // at all times
  // Why this surface cannot carry an area light, as a sentence; null where it can.
  virtual const char* EmitterProblem() const { return nullptr; }

  // Uniform by area, pdf = 1 / Area(), unless a map stretches the surface unevenly: then uniform
  // before that map, with the density that this has behind it. u chooses the point, uSubLight the
  // part where there are several. The caller sets the point's time.
  virtual EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const = 0;

  // A point seen from ref; density per solid angle at ref. nullopt: no sample (edge-on,
  // degenerate). Base class: by area, converted.
  virtual std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                                    Real uSubLight) const;
  // Density with which SampleToward makes the direction from ref to `on`, a point on this surface
  // that a ray from ref in direction wi hit.
  virtual Real PdfToward(const SurfacePoint& ref, const Vector3& wi, const SurfacePoint& on) const;
};

class Shape : public EmitterSurface {
 public:
  // First hit with 0 < t < ray.tMax.
  virtual std::optional<ShapeHit> Intersect(const Ray& ray) const = 0;
  virtual bool Occludes(const Ray& ray) const { return Intersect(ray).has_value(); }

  // The surface at a hit of that ray: p, pError, ng, uv, dpdu, dpdv, dndu, dndv and shading (equal
  // to the true geometry). The caller sets wo, time, material, light and motion.
  virtual SurfaceInteraction Surface(const Ray& ray, const ShapeHit& hit) const = 0;
};

struct TriangleMesh;

// What a shape plugin makes: one Shape, or a mesh of triangles.
using ShapeGeometry = std::variant<std::unique_ptr<Shape>, std::unique_ptr<TriangleMesh>>;

}  // namespace exphoton
