// SPDX-License-Identifier: BSD-2-Clause
// TriangleMesh holds triangles as flat arrays in world space. Shape plugins make it and drop
// degenerate triangles (DropDegenerate), so that later code meets only proper triangles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/shape.h"

namespace exphoton {

template <class T>
class Texture;

struct TriangleMesh {
  std::vector<std::array<std::uint32_t, 3>> indices;
  std::vector<Point3> p;
  std::vector<Normal3> n;  // empty or one per vertex; unit or 0 (0: use the geometric normal)
  std::vector<Vector3> s;  // empty or one per vertex: shading tangents
  std::vector<Point2> uv;  // empty or one per vertex; empty means (0,0) (1,0) (1,1)
  // The geometric normal is Cross(p1 - p0, p2 - p0), negated if flipNormal is set
  // (ReverseOrientation xor a transformation that swaps handedness).
  bool flipNormal = false;
  // Where this is 0, the mesh has no surface; null: it has none of these places.
  std::shared_ptr<const Texture<Real>> alpha;

  std::size_t TriangleCount() const { return indices.size(); }
  // Removes triangles of zero area (computed in double) and returns their number.
  std::size_t DropDegenerate();
};

// TriangleRay holds the part of the watertight ray-triangle test that depends on the ray only. It
// is computed once per ray. Source: Woop, Benthin and Wald 2013, "Watertight Ray/Triangle
// Intersection" (JCGT 2:1).
struct TriangleRay {
  Point3 o;
  int kx, ky, kz;   // kz: the axis of the largest direction component
  Real ox, oy, oz;  // origin along kx, ky, kz
  Real sx, sy, sz;

  // A table gives the axes, because branches on the axes of incoherent rays are unpredictable.
  explicit TriangleRay(const Ray& ray) : o(ray.o) {
    static constexpr int kNext[3] = {1, 2, 0};
    const Real origin[3] = {o.x, o.y, o.z}, d[3] = {ray.d.x, ray.d.y, ray.d.z};
    kz = MaxDimension(Abs(ray.d));
    kx = kNext[kz];
    ky = kNext[kx];
    ox = origin[kx], oy = origin[ky], oz = origin[kz];
    const Real dz = d[kz];
    sz = dz == 0 ? std::numeric_limits<Real>::quiet_NaN() : 1 / dz;
    sx = dz == 0 ? sz : d[kx] / dz;
    sy = dz == 0 ? sz : d[ky] / dz;
  }
};

struct TriangleHit {
  Real t, b1, b2;  // p = (1 - b1 - b2) p0 + b1 p1 + b2 p2
};

// Returns whether the ray misses the triangle, by its edges alone. It is never true for a triangle
// that IntersectTriangle would hit. Inner loops use it, because it rejects most triangles.
inline bool MissesTriangle(const TriangleRay& ray, const Point3& p0, const Point3& p1,
                           const Point3& p2) {
  const auto misses = [&]<int kz>() {
    constexpr int kx = (kz + 1) % 3, ky = (kz + 2) % 3;
    const Real ox = ray.ox, oy = ray.oy, oz = ray.oz;
    const Real az = p0[kz] - oz, bz = p1[kz] - oz, cz = p2[kz] - oz;
    const Real ax = (p0[kx] - ox) - ray.sx * az, ay = (p0[ky] - oy) - ray.sy * az;
    const Real bx = (p1[kx] - ox) - ray.sx * bz, by = (p1[ky] - oy) - ray.sy * bz;
    const Real cx = (p2[kx] - ox) - ray.sx * cz, cy = (p2[ky] - oy) - ray.sy * cz;
    const Real u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    // Both comparisons are false for a NaN, so the full test decides.
    return (u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0);
  };
  if (ray.kz == 0) return misses.template operator()<0>();
  return ray.kz == 1 ? misses.template operator()<1>() : misses.template operator()<2>();
}

// Returns the hit with 0 < t <= tMax and t above its own error bound. A t equal to tMax is a hit,
// so that the caller can decide ties by index.
std::optional<TriangleHit> IntersectTriangle(const TriangleRay& ray, Real tMax, const Point3& p0,
                                             const Point3& p1, const Point3& p2);

// Returns the surface record of triangle `index` of the mesh at barycentrics (b1, b2).
SurfaceInteraction TriangleSurface(const TriangleMesh& mesh, std::uint32_t index, Real b1, Real b2);

// MakeMeshEmitter returns a surface that samples the mesh: a triangle in proportion to its area,
// then a point on it. The surface keeps a reference to `mesh`.
class MeshEmitter;
std::unique_ptr<EmitterSurface> MakeMeshEmitter(const TriangleMesh& mesh);

}  // namespace exphoton
