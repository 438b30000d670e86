// SPDX-License-Identifier: BSD-2-Clause
// Clipping by the six planes of the box in turn (Sutherland and Hodgman 1974), in double.
#include "accelerators/kd/clip_triangle.h"

#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

struct Polygon {
  // A plane adds one corner; where rounding has bent the outline, at most half as many as there
  // are.
  std::array<Vec3d, 32> corners;
  int count = 0;
  void Add(const Vec3d& p) { corners[std::size_t(count++)] = p; }
};

// The part where sign * (p[axis] - plane) >= 0.
Polygon ClipByPlane(const Polygon& polygon, int axis, double plane, double sign) {
  Polygon result;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec3d& a = polygon.corners[std::size_t(i)];
    const Vec3d& b = polygon.corners[std::size_t((i + 1) % polygon.count)];
    const double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
    if (da >= 0) result.Add(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) result.Add(a + (b - a) * (da / (da - db)));
  }
  return result;
}

}  // namespace

Bounds3 ClipTriangle(const std::array<Point3, 3>& triangle, const Bounds3& box) {
  Polygon polygon;
  for (const Point3& p : triangle) polygon.Add(Vec3d(p));
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    polygon = ClipByPlane(polygon, axis, double(box.min[axis]), 1);
    polygon = ClipByPlane(polygon, axis, double(box.max[axis]), -1);
  }
  Bounds3 bounds;
  for (int i = 0; i < polygon.count; ++i) bounds.Extend(polygon.corners[std::size_t(i)].ToReal());
  return bounds;
}

}  // namespace exphoton
