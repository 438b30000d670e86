// SPDX-License-Identifier: BSD-2-Clause
// QuadricShape transforms hits from object space to world space, with bounds on their errors.
#include "shapes/quadric/quadric.h"

namespace exphoton {
namespace {

// Relative rounding error of a computation in double precision in object space. It covers the
// solution and both transformations, and is far below one rounding of float.
constexpr double kSolveError = 64 * std::numeric_limits<double>::epsilon();

double LargestOf(const Vec3d& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// A hit below this t may be the origin of the ray.
double SmallestT(const ObjectRay& ray) {
  return kSolveError / 4 * LargestOf(ray.o) / LargestOf(ray.d);
}

}  // namespace

QuadricRoots IntersectRound(const Vec3d& o, const Vec3d& d, double radius) {
  const double a = Dot(d, d);
  if (!(a > 0)) return {};
  const double nearest = -Dot(o, d) / a;
  const double distance = Length(o + d * nearest);
  const double half2 = (radius - distance) * (radius + distance) / a;
  if (!(half2 >= 0)) return {};
  const double half = std::sqrt(half2);
  return {2, {nearest - half, nearest + half}};
}

double AzimuthOf(double x, double y) {
  const double phi = std::atan2(y, x);
  return phi < 0 ? phi + 6.283185307179586 : phi;
}

QuadricShape::QuadricShape(const ShapeContext& context)
    : objectToWorld_(context.objectToWorld), side_(context.reverseOrientation ? -1 : 1) {}

ObjectRay QuadricShape::ToObject(const Ray& ray) const {
  const auto& m = objectToWorld_.InverseMatrix().m;
  const Vec3d d(ray.d);
  const auto row = [&](std::size_t i) { return m[i][0] * d.x + m[i][1] * d.y + m[i][2] * d.z; };
  return {PointToObject(Vec3d(ray.o)), {row(0), row(1), row(2)}};
}

Vec3d QuadricShape::PointToObject(const Vec3d& q) const {
  const auto& m = objectToWorld_.InverseMatrix().m;
  const auto row = [&](std::size_t i) {
    return m[i][0] * q.x + m[i][1] * q.y + m[i][2] * q.z + m[i][3];
  };
  return {row(0), row(1), row(2)};
}

std::optional<ShapeHit> QuadricShape::Intersect(const Ray& ray) const {
  const ObjectRay local = ToObject(ray);
  const QuadricRoots roots = Roots(local);
  for (int i = 0; i < roots.count; ++i) {
    const double t = roots.t[i];
    const Real rounded = Real(t);
    if (!(rounded > 0) || !(t > SmallestT(local))) continue;
    if (!(rounded < ray.tMax)) break;
    if (Has(local.At(t))) return ShapeHit{rounded, {Real(i), 0}};
  }
  return std::nullopt;
}

SurfaceInteraction QuadricShape::Surface(const Ray& ray, const ShapeHit& hit) const {
  // Solve again, because t rounded to Real places a distant hit only roughly along the ray.
  const ObjectRay local = ToObject(ray);
  const QuadricRoots roots = Roots(local);
  const int root = hit.uv.x > 0 ? 1 : 0;
  const QuadricPoint point = Describe(local.At(root < roots.count ? roots.t[root] : double(hit.t)));

  SurfaceInteraction surface;
  static_cast<SurfacePoint&>(surface) = PointToWorld(point.p, point.n);
  surface.uv = point.uv;
  surface.dpdu = objectToWorld_.ApplyVector(point.dpdu.ToReal());
  surface.dpdv = objectToWorld_.ApplyVector(point.dpdv.ToReal());
  const Vec3d u(surface.dpdu), v(surface.dpdv);
  if (!(Length(Cross(u, v)) > 1e-9 * Length(u) * Length(v)) || !IsFinite(surface.dpdu) ||
      !IsFinite(surface.dpdv)) {
    const Frame frame = Frame::FromZ(surface.ng);
    const Real size = Real(std::max({Length(u), Length(v), LargestOf(Vec3d(surface.p)) * 1e-6}));
    surface.dpdu = frame.x * size;
    surface.dpdv = frame.y * size;
  }
  const auto derivative = [&](const Vec3d& dn) {
    const Vec3d image(objectToWorld_.ApplyNormal(point.n.ToReal()));
    const Vec3d across(objectToWorld_.ApplyNormal(dn.ToReal()));
    const double length = Length(image);
    if (!(length > 0)) return Vector3();
    const Vec3d unit = image * (1 / length);
    return ((across - unit * Dot(unit, across)) * (side_ / length)).ToReal();
  };
  surface.dndu = derivative(point.dndu);
  surface.dndv = derivative(point.dndv);
  surface.shading.n = surface.ng;
  surface.shading.dpdu = surface.dpdu;
  surface.shading.dpdv = surface.dpdv;
  surface.shading.dndu = surface.dndu;
  surface.shading.dndv = surface.dndv;
  return surface;
}

Normal3 QuadricShape::NormalToWorld(const Vec3d& n) const {
  const auto& m = objectToWorld_.InverseMatrix().m;
  const auto column = [&](std::size_t i) { return m[0][i] * n.x + m[1][i] * n.y + m[2][i] * n.z; };
  return (NormalizeOrZero({column(0), column(1), column(2)}) * side_).ToReal();
}

SurfacePoint QuadricShape::PointToWorld(const Vec3d& p, const Vec3d& n) const {
  const auto& m = objectToWorld_.Matrix().m;
  SurfacePoint point;
  double largest = 0;
  for (int i = 0; i < 3; ++i) {
    const auto& row = m[std::size_t(i)];
    const double value = row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3];
    largest = std::max(largest, std::abs(row[0] * p.x) + std::abs(row[1] * p.y) +
                                    std::abs(row[2] * p.z) + std::abs(row[3]));
    point.p[i] = Real(value);
  }
  for (int i = 0; i < 3; ++i) {
    point.pError[i] =
        Real(double(Gamma(2)) * std::abs(double(point.p[i])) + 4 * kSolveError * largest);
  }
  point.ng = NormalToWorld(n);
  return point;
}

EmitterSample QuadricShape::MakeSample(const QuadricPoint& point, Real areaPdf) const {
  return {PointToWorld(point.p, point.n), point.uv, areaPdf};
}

std::optional<double> QuadricShape::AreaScale() const {
  const auto scale = objectToWorld_.SimilarityScale();
  if (!scale) return std::nullopt;
  return double(*scale) * double(*scale);
}

}  // namespace exphoton
