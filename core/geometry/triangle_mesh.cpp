// SPDX-License-Identifier: BSD-2-Clause
// TriangleSurface computes the surface at a triangle hit: position with error bound, derivatives by
// u and v, and interpolated shading normals. If uv, normals or tangents are degenerate, the plain
// geometry replaces them; every threshold is relative to the data's own size. The winding defines
// the outside (Cross(p1 - p0, p2 - p0), negated by flipNormal). Vertex normals only bend the
// shading normal, which is put on the outside.
#include "core/geometry/triangle_mesh.h"

#include "core/geometry/triangle_point.h"
#include "core/geometry/vec3d.h"

namespace exphoton {
namespace {

struct Corner {
  Vec3d p;
  Point2 uv;
};
using Corners = std::array<Corner, 3>;

Corners CornersOf(const TriangleMesh& mesh, std::uint32_t index) {
  const auto& v = mesh.indices[index];
  Corners corners;
  constexpr Point2 kDefaultUv[3] = {{0, 0}, {1, 0}, {1, 1}};
  for (std::size_t i = 0; i < 3; ++i) {
    corners[i].p = Vec3d(mesh.p[v[i]]);
    corners[i].uv = mesh.uv.empty() ? kDefaultUv[i] : mesh.uv[v[i]];
  }
  return corners;
}

// Returns whether the sine between two vectors is at most 1e-9. The arguments are the squared
// lengths of their cross product and of both. Doubles hold these products of single-precision
// vectors.
bool AreParallel(double cross2, double a2, double b2) { return cross2 <= 1e-18 * a2 * b2; }

// UvGradient solves f(u,v) = f0 + fu u + fv v from the differences of f along two edges. The
// determinant is set to 0 if the uv edges are parallel or zero.
struct UvGradient {
  double du1, dv1, du2, dv2, determinant;

  explicit UvGradient(const Corners& c) {
    du1 = double(c[1].uv.x) - double(c[0].uv.x), dv1 = double(c[1].uv.y) - double(c[0].uv.y);
    du2 = double(c[2].uv.x) - double(c[0].uv.x), dv2 = double(c[2].uv.y) - double(c[0].uv.y);
    determinant = du1 * dv2 - dv1 * du2;
    if (AreParallel(determinant * determinant, du1 * du1 + dv1 * dv1, du2 * du2 + dv2 * dv2))
      determinant = 0;
  }
  Vec3d ByU(const Vec3d& f1, const Vec3d& f2) const {
    return (f1 * dv2 - f2 * dv1) * (1 / determinant);
  }
  Vec3d ByV(const Vec3d& f1, const Vec3d& f2) const {
    return (f2 * du1 - f1 * du2) * (1 / determinant);
  }
};

// Sets the derivatives of the position. If uv is degenerate, they are a frame about the normal,
// scaled to the triangle's width.
void SetDerivatives(const Corners& c, const UvGradient& gradient, SurfaceInteraction* surface) {
  const Vec3d e1 = c[1].p - c[0].p, e2 = c[2].p - c[0].p;
  if (gradient.determinant != 0) {
    surface->dpdu = gradient.ByU(e1, e2).ToReal();
    surface->dpdv = gradient.ByV(e1, e2).ToReal();
    const Vec3d u(surface->dpdu), v(surface->dpdv), across = Cross(u, v);
    if (IsFinite(surface->dpdu) && IsFinite(surface->dpdv) &&
        !AreParallel(Dot(across, across), Dot(u, u), Dot(v, v))) {
      return;
    }
  }
  const Frame frame = Frame::FromZ(surface->ng);
  const Real width = Real(std::sqrt(Length(Cross(e1, e2))));
  surface->dpdu = frame.x * width;
  surface->dpdv = frame.y * width;
}

// Sets the interpolated normal and its derivatives. The true geometry stays if the vertex normals
// cancel or one of them is 0.
void SetShadingNormal(const TriangleMesh& mesh, std::uint32_t index,
                      const std::array<double, 3>& weight, const UvGradient& gradient,
                      SurfaceInteraction* surface) {
  const auto& v = mesh.indices[index];
  std::array<Vec3d, 3> n;
  for (std::size_t i = 0; i < 3; ++i) n[i] = Vec3d(mesh.n[v[i]]);
  for (const Vec3d& each : n)
    if (Dot(each, each) == 0) return;
  const Vec3d sum = n[0] * weight[0] + n[1] * weight[1] + n[2] * weight[2];
  const double length = Length(sum);
  if (!(length > 1e-6)) return;
  const double side = Dot(sum, Vec3d(surface->ng)) < 0 ? -1 : 1;
  const Vec3d unit = sum * (side / length);
  surface->shading.n = unit.ToReal();
  if (gradient.determinant == 0) return;
  // The derivative of the normalised sum is the part perpendicular to the normal, divided by the
  // length.
  const auto across = [&](const Vec3d& d) {
    return ((d - unit * Dot(unit, d)) * (side / length)).ToReal();
  };
  const Vec3d e1 = n[1] - n[0], e2 = n[2] - n[0];
  const Vector3 dndu = across(gradient.ByU(e1, e2)), dndv = across(gradient.ByV(e1, e2));
  if (!IsFinite(dndu) || !IsFinite(dndv)) return;
  surface->shading.dndu = dndu;
  surface->shading.dndv = dndv;
}

// Sets the tangents in the shading plane, with the lengths of dpdu and dpdv. The first tangent
// follows the mesh's own tangents if there are any.
void SetShadingTangents(const TriangleMesh& mesh, std::uint32_t index,
                        const std::array<double, 3>& weight, SurfaceInteraction* surface) {
  const Vec3d n(surface->shading.n), u(surface->dpdu), v(surface->dpdv);
  // Returns the unit direction of a within the shading plane, or 0 if a is along the normal.
  const auto inPlane = [&](const Vec3d& a) {
    const Vec3d flat = a - n * Dot(n, a);
    return Length(flat) > 1e-6 * Length(a) ? NormalizeOrZero(flat) : Vec3d();
  };
  const auto isZero = [](const Vec3d& a) { return Dot(a, a) == 0; };
  Vec3d first, second;
  if (mesh.s.empty()) {
    second = inPlane(v);
  } else {
    const auto& corner = mesh.indices[index];
    first = inPlane(Vec3d(mesh.s[corner[0]]) * weight[0] + Vec3d(mesh.s[corner[1]]) * weight[1] +
                    Vec3d(mesh.s[corner[2]]) * weight[2]);
  }
  if (isZero(first)) first = inPlane(u);
  if (isZero(first)) first = Vec3d(Frame::FromZ(surface->shading.n).x);
  if (Length(Cross(first, second)) < 1e-6)
    second = Cross(n, first) * (Dot(Cross(u, v), n) < 0 ? -1.0 : 1.0);
  surface->shading.dpdu = (first * Length(u)).ToReal();
  surface->shading.dpdv = (second * Length(v)).ToReal();
}

}  // namespace

std::size_t TriangleMesh::DropDegenerate() {
  const auto isDegenerate = [&](const std::array<std::uint32_t, 3>& v) {
    const Vec3d a(p[v[0]]);
    const Vec3d n = Cross(Vec3d(p[v[1]]) - a, Vec3d(p[v[2]]) - a);
    return Dot(NormalizeOrZero(n), NormalizeOrZero(n)) == 0;
  };
  return std::erase_if(indices, isDegenerate);
}

SurfaceInteraction TriangleSurface(const TriangleMesh& mesh, std::uint32_t index, Real b1,
                                   Real b2) {
  const Corners c = CornersOf(mesh, index);
  const std::array<double, 3> weight = {1 - double(b1) - double(b2), double(b1), double(b2)};

  SurfaceInteraction surface;
  static_cast<SurfacePoint&>(surface) = TrianglePoint(c[0].p, c[1].p, c[2].p, b1, b2);
  if (mesh.flipNormal) surface.ng = -surface.ng;
  const auto blend = [&](double f0, double f1, double f2) {
    return Real(weight[0] * f0 + weight[1] * f1 + weight[2] * f2);
  };
  surface.uv = {blend(double(c[0].uv.x), double(c[1].uv.x), double(c[2].uv.x)),
                blend(double(c[0].uv.y), double(c[1].uv.y), double(c[2].uv.y))};

  const UvGradient gradient(c);
  SetDerivatives(c, gradient, &surface);
  surface.shading.n = surface.ng;
  surface.shading.dpdu = surface.dpdu;
  surface.shading.dpdv = surface.dpdv;
  if (!mesh.n.empty()) SetShadingNormal(mesh, index, weight, gradient, &surface);
  if (!mesh.n.empty() || !mesh.s.empty()) SetShadingTangents(mesh, index, weight, &surface);
  return surface;
}

}  // namespace exphoton
