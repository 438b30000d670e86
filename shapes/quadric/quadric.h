// SPDX-License-Identifier: BSD-2-Clause
// What sphere, disk, cylinder and their kin share: rays are taken to object space and solved there
// in double; hits come back as points that lie on the surface to the last place of Real. Not a
// shape by itself.
#pragma once

#include <span>

#include "core/geometry/vec3d.h"
#include "core/plugins/kinds.h"

namespace exphoton {

// A ray in object space; direction not normalised, so that t is that of the world.
struct ObjectRay {
  Vec3d o, d;
  Vec3d At(double t) const { return o + d * t; }
};

// A point of a quadric in object space, exactly on it.
struct QuadricPoint {
  Vec3d p;
  Vec3d n;  // unit, outside before reverseOrientation
  Point2 uv;
  Vec3d dpdu, dpdv;  // 0 where the parametrisation is singular
  Vec3d dndu, dndv;
};

struct QuadricRoots {
  int count = 0;
  double t[2] = {0, 0};  // ascending

  std::span<const double> All() const { return {t, std::size_t(count)}; }
};

// Where |o + t d| = radius, for a vector of two or three components given as Vec3d (z 0 for two).
// Solved about the point nearest to the centre: o and d may be any size and o far away.
// Hearn and Baker 2004; Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection".
QuadricRoots IntersectRound(const Vec3d& o, const Vec3d& d, double radius);

// Azimuth of (x, y) in [0, 2 pi].
double AzimuthOf(double x, double y);

class QuadricShape : public Shape {
 public:
  SurfaceInteraction Surface(const Ray& ray, const ShapeHit& hit) const final;
  std::optional<ShapeHit> Intersect(const Ray& ray) const final;

 protected:
  explicit QuadricShape(const ShapeContext& context);

  // Parameters where the ray meets the unbounded quadric, whether or not that part exists here.
  virtual QuadricRoots Roots(const ObjectRay& ray) const = 0;
  // Whether the point (near the surface) is on the part that this shape has.
  virtual bool Has(const Vec3d& p) const = 0;
  // The surface at the point of it that is nearest to p.
  virtual QuadricPoint Describe(const Vec3d& p) const = 0;

  ObjectRay ToObject(const Ray& ray) const;
  Vec3d PointToObject(const Vec3d& p) const;
  SurfacePoint PointToWorld(const Vec3d& p, const Vec3d& n) const;
  // A sample at that point with that density per area.
  EmitterSample MakeSample(const QuadricPoint& point, Real areaPdf) const;
  // Scale factor of areas where it is the same for all normals, else nullopt.
  std::optional<double> AreaScale() const;
  // The same shape in its own space, where every area is its own.
  static ShapeContext InOwnSpace(const ShapeContext& context) {
    return {Transform(), context.reverseOrientation, context.log, context.where};
  }

  Transform objectToWorld_;
  double side_;  // -1 where the scene reverses the orientation

 private:
  Normal3 NormalToWorld(const Vec3d& n) const;
};

}  // namespace exphoton
