// SPDX-License-Identifier: BSD-2-Clause
// The shape "heightfield" is a grid of heights over the unit square, with two triangles a cell. x
// and y run from 0 to 1 and are the texture coordinates. x runs fastest in the list of heights.
#include "core/plugin.h"
#include "shapes/mesh/finish_mesh.h"

namespace exphoton {
namespace {

struct Settings {
  int columns = 0, rows = 0;
  std::vector<Real> heights;

  void Validate() const {
    const std::size_t needed = std::size_t(columns) * std::size_t(rows);
    if (heights.size() != needed) {
      throw ParamError{"Pz",
                       "has " + std::to_string(heights.size()) + " heights for " +
                           std::to_string(columns) + " x " + std::to_string(rows) + " vertices",
                       "give nu times nv"};
    }
  }
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("nu", &Settings::columns, "vertices along x").Required().Range(2, 1 << 20),
      Param("nv", &Settings::rows, "vertices along y").Required().Range(2, 1 << 20),
      Param("Pz", &Settings::heights, "height of each vertex, x fastest")
          .Required()
          .Unit("scene units")};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  auto mesh = std::make_unique<TriangleMesh>();
  const auto columns = std::uint32_t(settings.columns), rows = std::uint32_t(settings.rows);
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      const Point2 uv(Real(x) / Real(columns - 1), Real(y) / Real(rows - 1));
      mesh->p.push_back({uv.x, uv.y, settings.heights[std::size_t(y) * columns + x]});
      mesh->uv.push_back(uv);
    }
  }
  for (std::uint32_t y = 0; y + 1 < rows; ++y) {
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t corner = y * columns + x, above = corner + columns;
      mesh->indices.push_back({corner, corner + 1, above + 1});
      mesh->indices.push_back({corner, above + 1, above});
    }
  }
  return FinishMesh(std::move(mesh), context, "Pz");
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("heightfield", "a grid of heights over the unit square")
