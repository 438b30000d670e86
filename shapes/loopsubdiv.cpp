// SPDX-License-Identifier: BSD-2-Clause
// The shape "loopsubdiv" is the limit surface of Loop subdivision of a triangle mesh, as a finer
// mesh with limit positions and limit normals. (pbrt-v1 computes normals from the ring of limit
// positions, which is exact only in the limit. At low levels its highlights lie elsewhere.)
#include "core/plugin.h"
#include "shapes/mesh/finish_mesh.h"
#include "shapes/mesh/loop_subdivision.h"

namespace exphoton {
namespace {

struct Settings {
  int levels = 3;
  std::vector<int> indices;
  std::vector<Point3> positions;
  std::string scheme = "loop";
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nlevels", &Settings::levels, "times that every triangle is split in four")
          .Range(0, 12),
      Param("indices", &Settings::indices, "three vertex numbers a triangle").Required(),
      Param("P", &Settings::positions, "vertices of the control mesh")
          .Required()
          .Unit("scene units"),
      Param("scheme", &Settings::scheme,
            "rule of subdivision; any other than \"loop\" is ignored")};
  return table;
}

// Peak memory of LoopSubdivide per triangle of the finest mesh: its sides during sorting, its
// edges, the sums around its vertices, two meshes. Measured for the whole program: 155 bytes at 9
// levels, 126 at 10.
constexpr double kBytesPerTriangle = 160;

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  if (settings.scheme != "loop")
    context.log.Warning(
        "subdivision scheme \"" + settings.scheme + "\" is not available: \"loop\" is used instead",
        context.where);
  SubdivisionMesh control;
  control.faces = CheckedTriangles(settings.indices, settings.positions.size(), "indices");
  for (const Point3& p : settings.positions) control.positions.push_back(Vec3d(p));
  if (!IsManifold(control)) {
    throw ParamError{"indices",
                     "has an edge with more than two triangles, or a triangle that names a vertex "
                     "twice",
                     "subdivision needs a surface"};
  }
  const double count = double(control.faces.size()) * std::pow(4.0, settings.levels);
  CheckTriangleCount(count, "nlevels");
  CheckMemory(count * kBytesPerTriangle,
              "subdivision with nlevels " + std::to_string(settings.levels),
              "each level less needs a quarter of the memory", context.where);
  LimitMesh limit = LoopSubdivide(std::move(control), settings.levels);
  auto mesh = std::make_unique<TriangleMesh>();
  mesh->indices = std::move(limit.mesh.faces);
  for (const Vec3d& p : limit.mesh.positions) mesh->p.push_back(p.ToReal());
  for (const Vec3d& n : limit.normals) mesh->n.push_back(n.ToReal());
  return FinishMesh(std::move(mesh), context, "P");
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("loopsubdiv", "the limit surface of Loop subdivision")
