// SPDX-License-Identifier: BSD-2-Clause
// ClipTriangle clips by the box's six planes in turn (Sutherland and Hodgman 1974), in double
// precision.
#include "accelerators/kd/clip_triangle.h"

#include <utility>

namespace exphoton {
namespace {

// Polygon is a triangle after some clipping. Each plane adds at most one corner to a convex
// polygon. If rounding has made the polygon concave, a plane adds at most half of its corners, so
// six planes give at most 28.
struct Polygon {
  double corners[32][3];  // not initialised: most planes cut few triangles
  int count = 0;
};

// Copies the part of `from` where sign * (p[axis] - plane) >= 0. If the plane cuts nothing off,
// does nothing and returns false.
bool ClipByPlane(const Polygon& from, int axis, double plane, double sign, Polygon* to) {
  bool isCut = false;
  for (int i = 0; i < from.count; ++i) isCut |= sign * (from.corners[i][axis] - plane) < 0;
  if (!isCut) return false;
  to->count = 0;
  for (int i = 0; i < from.count; ++i) {
    const double* a = from.corners[i];
    const double* b = from.corners[i + 1 < from.count ? i + 1 : 0];
    const double da = sign * (a[axis] - plane), db = sign * (b[axis] - plane);
    if (da >= 0) std::copy(a, a + 3, to->corners[to->count++]);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const double s = da / (da - db);
      double* p = to->corners[to->count++];
      for (int k = 0; k < 3; ++k) p[k] = a[k] + (b[k] - a[k]) * s;
    }
  }
  return true;
}

}  // namespace

Bounds3 ClipTriangle(const std::array<Point3, 3>& triangle, const Bounds3& box) {
  Polygon buffers[2];
  Polygon *now = &buffers[0], *next = &buffers[1];
  for (const Point3& p : triangle) {
    double* corner = now->corners[now->count++];
    for (int k = 0; k < 3; ++k) corner[k] = double(p[k]);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (ClipByPlane(*now, axis, double(box.min[axis]), 1, next)) std::swap(now, next);
    if (ClipByPlane(*now, axis, double(box.max[axis]), -1, next)) std::swap(now, next);
  }
  Bounds3 bounds;
  for (int i = 0; i < now->count; ++i) {
    const double* p = now->corners[i];
    bounds.Extend(Point3(Real(p[0]), Real(p[1]), Real(p[2])));
  }
  return bounds;
}

}  // namespace exphoton
