// SPDX-License-Identifier: BSD-2-Clause
// Shape is the interface of surfaces that are not triangles, such as quadrics. EmitterSurface is
// the interface of a surface that carries an area light. Everything is in world space. Triangle
// meshes are plain arrays (triangle_mesh.h), not Shapes.
#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "core/geometry/interaction.h"
#include "core/math/bounds.h"

namespace exphoton {

struct ShapeHit {
  Real t;     // 0 < t < tMax, larger than its own error bound
  Point2 uv;  // two numbers that the shape gets back in Surface()
};

struct EmitterSample {
  SurfacePoint point;
  Point2 uv;
  Real pdf;  // per area for SamplePoint, per solid angle at the reference for SampleToward; > 0
};

// EmitterSurface is a surface that can be sampled. Direction arguments have unit length. All points
// of a query belong to one time, the time of the reference point. This time matters only for moving
// surfaces.
class EmitterSurface {
 public:
  virtual ~EmitterSurface() = default;

  // Returns the area. If the area changes in time, the result is approximately its mean. The call
  // may be slow, so keep the result.
  virtual Real Area() const = 0;
  virtual Bounds3 Bounds() const = 0;  // at all times
  // Returns false only if no ray that leaves the surface on the side of its normals hits the box,
  // at any time.
  virtual bool MayFace(const Bounds3&) const { return true; }
  // Returns the reason why this surface cannot carry an area light, as a sentence, or null if it
  // can.
  virtual const char* EmitterProblem() const { return nullptr; }

  // Samples a point uniformly by area, with pdf = 1 / Area(). If a map stretches the surface
  // unevenly, the point is uniform before the map, and pdf is the density after it. u chooses the
  // point; uSubLight chooses the part of a surface with several parts. The caller sets the point's
  // time.
  virtual EmitterSample SamplePoint(Point2 u, Real uSubLight, Real time) const = 0;

  // Returns whether the pdf of SamplePoint is 1 / Area() everywhere, at all times.
  virtual bool IsSampledUniformly() const { return true; }

  // Samples a point as seen from ref, with its density per solid angle at ref. Returns nullopt if
  // there is no sample (edge-on, degenerate). The base class samples by area and converts the
  // density.
  virtual std::optional<EmitterSample> SampleToward(const SurfacePoint& ref, Point2 u,
                                                    Real uSubLight) const;
  // Returns the density with which SampleToward makes the direction from ref to `on`. `on` is a
  // point on this surface that a ray from ref in direction wi hit.
  virtual Real PdfToward(const SurfacePoint& ref, const Vector3& wi, const SurfacePoint& on) const;
};

class Shape : public EmitterSurface {
 public:
  // Returns the first hit with 0 < t < ray.tMax.
  virtual std::optional<ShapeHit> Intersect(const Ray& ray) const = 0;
  virtual bool Occludes(const Ray& ray) const { return Intersect(ray).has_value(); }

  // Returns the surface at a hit of `ray`: p, pError, ng, uv, dpdu, dpdv, dndu, dndv and shading
  // (equal to the true geometry). The caller sets wo, time, material, light and motion.
  virtual SurfaceInteraction Surface(const Ray& ray, const ShapeHit& hit) const = 0;
};

struct TriangleMesh;

// ShapeGeometry is the result of a shape plugin: one Shape, or a mesh of triangles.
using ShapeGeometry = std::variant<std::unique_ptr<Shape>, std::unique_ptr<TriangleMesh>>;

}  // namespace exphoton
