// SPDX-License-Identifier: BSD-2-Clause
// The shape "trianglemesh" has triangles given by indices into lists of positions and, optionally,
// normals, tangents and texture coordinates. Cross(p1 - p0, p2 - p0) points to the outside, from
// where the corners are counter-clockwise. Given normals only affect shading, not the side. Where
// "alpha" is 0, the mesh has holes for rays of all kinds, as in version 2.
#include <algorithm>

#include "core/plugin.h"
#include "core/scattering/texture.h"
#include "shapes/mesh/finish_mesh.h"

namespace exphoton {
namespace {

struct Settings {
  std::vector<int> indices;
  std::vector<Point3> positions;
  std::vector<Normal3> normals;
  std::vector<Vector3> tangents;
  std::vector<Point2> uv, st;
  TexturePtr<Real> alpha = Uniform(Real(1));
  bool discardDegenerateUvs = false;

  void Validate() const {
    const auto needSameCount = [&](const char* name, std::size_t count) {
      if (count != 0 && count != positions.size()) {
        throw ParamError{name,
                         "has " + std::to_string(count) + " entries for " +
                             std::to_string(positions.size()) + " points",
                         "give one a point of 'P', or none"};
      }
    };
    needSameCount("N", normals.size());
    needSameCount("S", tangents.size());
    needSameCount("uv", uv.size());
    needSameCount("st", st.size());
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("indices", &Settings::indices, "three vertex numbers a triangle").Required(),
      Param("P", &Settings::positions, "vertex positions").Required().Unit("scene units"),
      Param("N", &Settings::normals, "shading normals, one a vertex").As(ParamType::NormalList),
      Param("S", &Settings::tangents, "shading tangents, one a vertex").As(ParamType::VectorList),
      Param("uv", &Settings::uv, "texture coordinates, one pair a vertex"),
      Param("st", &Settings::st, "another name of 'uv'"),
      Param("alpha", &Settings::alpha, "where it is 0, the mesh has a hole"),
      Param("discarddegenerateUVs", &Settings::discardDegenerateUvs,
            "leaves out all texture coordinates if those of any triangle coincide")};
  return table;
}

// Returns whether two corners of any triangle have the same texture coordinates.
bool HasDegenerateUvs(const TriangleMesh& mesh) {
  return std::any_of(mesh.indices.begin(), mesh.indices.end(), [&](const auto& v) {
    const Point2 &a = mesh.uv[v[0]], &b = mesh.uv[v[1]], &c = mesh.uv[v[2]];
    return a == b || b == c || c == a;
  });
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->indices = CheckedTriangles(settings.indices, settings.positions.size(), "indices");
  mesh->p = settings.positions;
  mesh->n = settings.normals;
  mesh->s = settings.tangents;
  mesh->uv = settings.uv.empty() ? settings.st : settings.uv;
  if (settings.discardDegenerateUvs && !mesh->uv.empty() && HasDegenerateUvs(*mesh)) {
    context.log.Warning(
        "the mesh has triangles whose texture coordinates coincide: all texture "
        "coordinates are left out",
        context.where);
    mesh->uv.clear();
  }
  return FinishMesh(std::move(mesh), context, "P", settings.alpha);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("trianglemesh", "triangles by indices into lists of vertices")
