// SPDX-License-Identifier: BSD-2-Clause
// The shape "nurbs" is a non-uniform rational B-spline surface. It becomes a mesh with at least 30
// steps along u and v, 8 between two knots, and exact normals. A knot of full multiplicity is a
// crease with a normal on each side. The texture coordinates are the surface's parameters u and v.
#include "core/params/param_text.h"
#include "core/plugin.h"
#include "shapes/mesh/finish_mesh.h"
#include "shapes/mesh/nurbs_surface.h"

namespace exphoton {
namespace {

constexpr int kLeastSteps = 30, kStepsPerSpan = 8;
constexpr int kMaxControls = 1 << 20;  // along u or v

struct Settings {
  int uCount = 0, vCount = 0, uOrder = 0, vOrder = 0;
  std::vector<Real> uKnots, vKnots;
  std::optional<Real> u0, u1, v0, v1;
  std::vector<Point3> positions;
  std::vector<Real> homogeneous;  // x, y, z and weight of each control point

  void Validate() const {
    ValidateDirection("u", uCount, uOrder, uKnots);
    ValidateDirection("v", vCount, vOrder, vKnots);
    if (positions.empty() == homogeneous.empty())
      throw ParamError{"P", "needs either 'P' or 'Pw'", "'Pw' has four numbers a point"};
    const std::size_t needed = std::size_t(uCount) * std::size_t(vCount);
    const bool isRational = positions.empty();
    const std::size_t given = isRational ? homogeneous.size() : positions.size();
    if (given != needed * (isRational ? 4 : 1)) {
      throw ParamError{
          isRational ? "Pw" : "P",
          "has " + std::to_string(given) + (isRational ? " numbers for " : " points for ") +
              std::to_string(uCount) + " x " + std::to_string(vCount) + " control points",
          ""};
    }
    for (std::size_t i = 3; i < homogeneous.size(); i += 4)
      if (!(homogeneous[i] > 0))
        throw ParamError{"Pw", "has a weight that is not above 0",
                         "each fourth number is a weight"};
  }

 private:
  static void ValidateDirection(const std::string& axis, int count, int order,
                                const std::vector<Real>& knots) {
    if (order > count) {
      throw ParamError{axis + "order", "must be at most 'n" + axis + "'",
                       "a curve of order " + std::to_string(order) + " needs as many points"};
    }
    if (knots.size() != std::size_t(count + order)) {
      throw ParamError{axis + "knots",
                       "has " + std::to_string(knots.size()) + " knots, but needs " +
                           std::to_string(count + order),
                       "the number of knots is 'n" + axis + "' + '" + axis + "order'"};
    }
    if (!std::is_sorted(knots.begin(), knots.end()))
      throw ParamError{axis + "knots", "must not decrease", ""};
    if (knots[std::size_t(order - 1)] >= knots[std::size_t(count)])
      throw ParamError{axis + "knots", "has an empty domain", "the middle knots must differ"};
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nu", &Settings::uCount, "control points along u").Required().Range(1, kMaxControls),
      Param("nv", &Settings::vCount, "control points along v").Required().Range(1, kMaxControls),
      Param("uorder", &Settings::uOrder, "order along u: degree + 1").Required().Range(2, 64),
      Param("vorder", &Settings::vOrder, "order along v: degree + 1").Required().Range(2, 64),
      Param("uknots", &Settings::uKnots, "nu + uorder knots").Required(),
      Param("vknots", &Settings::vKnots, "nv + vorder knots").Required(),
      Param("u0", &Settings::u0, "start along u; start of the domain if absent"),
      Param("u1", &Settings::u1, "end along u; end of the domain if absent"),
      Param("v0", &Settings::v0, "start along v; start of the domain if absent"),
      Param("v1", &Settings::v1, "end along v; end of the domain if absent"),
      Param("P", &Settings::positions, "control points, u fastest").Unit("scene units"),
      Param("Pw", &Settings::homogeneous,
            "control points with weights: x, y and z times the weight, and the weight")};
  return table;
}

NurbsSurface SurfaceOf(const Settings& settings) {
  NurbsSurface surface{{settings.uOrder, {settings.uKnots.begin(), settings.uKnots.end()}},
                       {settings.vOrder, {settings.vKnots.begin(), settings.vKnots.end()}},
                       {}};
  for (const Point3& p : settings.positions) surface.controls.push_back({Vec3d(p), 1});
  const auto& list = settings.homogeneous;
  for (std::size_t i = 0; i + 3 < list.size(); i += 4) {
    surface.controls.push_back(
        {{double(list[i]), double(list[i + 1]), double(list[i + 2])}, double(list[i + 3])});
  }
  return surface;
}

// Returns the parameters of the mesh's vertices along one direction.
std::vector<NurbsParameter> Parameters(const NurbsBasis& basis, const std::string& axis,
                                       std::optional<Real> first, std::optional<Real> last) {
  const double from = first ? double(*first) : basis.First();
  const double to = last ? double(*last) : basis.Last();
  const auto check = [&](double value, const char* end) {
    if (value < basis.First() || value > basis.Last())
      throw ParamError{
          axis + end, "must lie within the knots' domain",
          "the domain runs from " + NumberText(basis.First()) + " to " + NumberText(basis.Last())};
  };
  check(from, "0");
  check(to, "1");
  if (from >= to) throw ParamError{axis + "0", "must be below '" + axis + "1'", ""};
  return basis.Subdivide(from, to, kLeastSteps, kStepsPerSpan);
}

// Each vertex has at most two triangles.
constexpr double kBytesPerVertex = sizeof(Point3) + sizeof(Normal3) + sizeof(Point2) +
                                   2 * sizeof(decltype(TriangleMesh::indices)::value_type);

std::unique_ptr<TriangleMesh> MeshOf(const NurbsSurface& surface,
                                     const std::vector<NurbsParameter>& u,
                                     const std::vector<NurbsParameter>& v) {
  const std::size_t vertices = u.size() * v.size();
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->p.reserve(vertices);
  mesh->n.reserve(vertices);
  mesh->uv.reserve(vertices);
  mesh->indices.reserve(2 * vertices);
  for (const NurbsParameter& t : v) {
    for (const NurbsParameter& s : u) {
      const NurbsPoint point = surface.At(s, t);
      mesh->p.push_back(point.p.ToReal());
      mesh->n.push_back(point.normal.ToReal());
      mesh->uv.push_back({Real(s.value), Real(t.value)});
    }
  }
  const auto columns = std::uint32_t(u.size()), rows = std::uint32_t(v.size());
  for (std::uint32_t y = 0; y + 1 < rows; ++y) {
    if (v[y].isFromLeft) continue;  // the next row is at the same place
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      if (u[x].isFromLeft) continue;
      const std::uint32_t corner = y * columns + x, above = corner + columns;
      mesh->indices.push_back({corner, corner + 1, above + 1});
      mesh->indices.push_back({corner, above + 1, above});
    }
  }
  return mesh;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  const NurbsSurface surface = SurfaceOf(settings);
  const auto u = Parameters(surface.u, "u", settings.u0, settings.u1);
  const auto v = Parameters(surface.v, "v", settings.v0, settings.v1);
  const double vertices = double(u.size()) * double(v.size());
  CheckTriangleCount(2 * vertices, u.size() < v.size() ? "nv" : "nu");
  CheckMemory(vertices * kBytesPerVertex,
              "a surface of " + std::to_string(settings.uCount) + " x " +
                  std::to_string(settings.vCount) + " control points",
              "fewer control points need less", context.where);
  return FinishMesh(MeshOf(surface, u, v), context, settings.positions.empty() ? "Pw" : "P");
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("nurbs", "a rational B-spline surface")
