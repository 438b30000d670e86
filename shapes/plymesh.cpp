// SPDX-License-Identifier: BSD-2-Clause
// The shape "plymesh" reads triangles and quads from a PLY file, which may be compressed by gzip.
// It has the meaning of version 3 of the scene language; version 1 does not have it.
#include "core/plugin.h"
#include "shapes/mesh/finish_mesh.h"
#include "shapes/mesh/ply_reader.h"

namespace exphoton {
namespace {

struct Settings {
  std::string fileName;
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("filename", &Settings::fileName, "PLY file, relative to the scene file")
          .As(ParamType::File)
          .Required()};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  try {
    return FinishMesh(ReadPly(settings.fileName), context, "filename");
  } catch (const PlyError& error) {
    throw ParamError{"filename", "cannot be used (" + settings.fileName + "): " + error.what(), ""};
  }
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("plymesh", "triangles and quads from a PLY file")
