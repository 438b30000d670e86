// SPDX-License-Identifier: BSD-2-Clause
// QuadricShape is the base class of sphere, disk and cylinder. It transforms rays to object space
// and solves there in double precision. Hit points lie on the surface to the last digit of Real.
#pragma once

#include <span>

#include "core/geometry/vec3d.h"
#include "core/plugins/kinds.h"

namespace exphoton {

// A ray in object space. Its direction is not normalised, so that t is the same as in world space.
struct ObjectRay {
  Vec3d o, d;
  Vec3d At(double t) const { return o + d * t; }
};

// A point in object space, exactly on the quadric.
struct QuadricPoint {
  Vec3d p;
  Vec3d n;  // unit, outward before reverseOrientation
  Point2 uv;
  Vec3d dpdu, dpdv;  // 0 where the parametrisation is singular
  Vec3d dndu, dndv;
};

struct QuadricRoots {
  int count = 0;
  double t[2] = {0, 0};  // ascending

  std::span<const double> All() const { return {t, std::size_t(count)}; }
};

// Solves |o + t d| = radius for vectors of two or three components (z is 0 for two). It solves
// about the point nearest to the centre, so o may be far away and d may have any length. Sources:
// Hearn and Baker 2004; Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection".
QuadricRoots IntersectRound(const Vec3d& o, const Vec3d& d, double radius);

// Returns the azimuth of (x, y) in [0, 2 pi].
double AzimuthOf(double x, double y);

class QuadricShape : public Shape {
 public:
  SurfaceInteraction Surface(const Ray& ray, const ShapeHit& hit) const final;
  std::optional<ShapeHit> Intersect(const Ray& ray) const final;

 protected:
  explicit QuadricShape(const ShapeContext& context);

  // Returns the parameters where the ray hits the unbounded quadric, also off this shape.
  virtual QuadricRoots Roots(const ObjectRay& ray) const = 0;
  // Returns whether a point near the surface is on the part of the quadric that this shape has.
  virtual bool Has(const Vec3d& p) const = 0;
  // Returns the surface at its point nearest to p.
  virtual QuadricPoint Describe(const Vec3d& p) const = 0;

  ObjectRay ToObject(const Ray& ray) const;
  Vec3d PointToObject(const Vec3d& p) const;
  SurfacePoint PointToWorld(const Vec3d& p, const Vec3d& n) const;
  // Returns a sample at `point` with the density areaPdf per area.
  EmitterSample MakeSample(const QuadricPoint& point, Real areaPdf) const;
  // Returns the scale factor of areas if it is the same for all normals, else nullopt.
  std::optional<double> AreaScale() const;
  // Returns the context of the same shape in object space, where areas are not scaled.
  static ShapeContext InOwnSpace(const ShapeContext& context) {
    return {Transform(), context.reverseOrientation, context.log, context.where};
  }

  Transform objectToWorld_;
  double side_;  // -1 if the scene reverses the orientation

 private:
  Normal3 NormalToWorld(const Vec3d& n) const;
};

}  // namespace exphoton
