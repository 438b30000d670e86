// SPDX-License-Identifier: BSD-2-Clause
// CutOutTriangle: the triangle test of the core, followed by a lookup of alpha.
#include "core/scene/cut_out_triangle.h"

#include <cmath>

#include "core/geometry/vec3d.h"
#include "core/scattering/texture.h"

namespace exphoton {

Real CutOutTriangle::Area() const {
  const Vec3d a(Corner(0));
  return Real(Length(Cross(Vec3d(Corner(1)) - a, Vec3d(Corner(2)) - a)) / 2);
}

EmitterSample CutOutTriangle::SamplePoint(Point2 u, Real, Real time) const {
  const Real root = std::sqrt(u.x), b1 = 1 - root, b2 = u.y * root;
  EmitterSample sample;
  const SurfaceInteraction surface = TriangleSurface(*mesh_, index_, b1, b2);
  sample.point = surface;
  sample.point.time = time;
  sample.uv = {b1, b2};
  sample.pdf = 1 / Area();
  return sample;
}

Bounds3 CutOutTriangle::Bounds() const {
  Bounds3 bounds(Corner(0), Corner(1));
  bounds.Extend(Corner(2));
  return bounds;
}

std::optional<ShapeHit> CutOutTriangle::Intersect(const Ray& ray) const {
  const auto hit = IntersectTriangle(TriangleRay(ray), ray.tMax, Corner(0), Corner(1), Corner(2));
  if (!hit || !(hit->t < ray.tMax)) return std::nullopt;
  const ShapeHit found{hit->t, {hit->b1, hit->b2}};
  if (mesh_->alpha->Evaluate(Surface(ray, found)) == 0) return std::nullopt;
  return found;
}

SurfaceInteraction CutOutTriangle::Surface(const Ray& ray, const ShapeHit& hit) const {
  SurfaceInteraction surface = TriangleSurface(*mesh_, index_, hit.uv.x, hit.uv.y);
  surface.time = ray.time;
  return surface;
}

}  // namespace exphoton
