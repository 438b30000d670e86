// SPDX-License-Identifier: BSD-2-Clause
// The shape "obj" reads polygons from a Wavefront OBJ file. The materials of the file have no
// effect: the scene's material counts. No version of the scene language has this shape.
#include "core/base/log.h"
#include "core/plugin.h"
#include "core/scattering/texture.h"
#include "shapes/mesh/finish_mesh.h"
#include "shapes/mesh/obj_reader.h"

namespace exphoton {
namespace {

struct Settings {
  std::string fileName, group;
  TexturePtr<Real> alpha = Uniform(Real(1));
};

const ParamTable<Settings>& Parameters() {
  static const ParamTable<Settings> table{
      Param("filename", &Settings::fileName, "OBJ file, relative to the scene file")
          .As(ParamType::File)
          .Required(),
      Param("group", &Settings::group, "takes the faces of this group or object only"),
      Param("alpha", &Settings::alpha, "where it is 0, the mesh has a hole")};
  return table;
}

std::unique_ptr<ShapeGeometry> Create(const Settings& settings, const ShapeContext& context) {
  try {
    ObjMesh obj = ReadObj(settings.fileName, settings.group);
    if (obj.namesMaterials)
      context.log.Notice("the materials of \"" + settings.fileName +
                             "\" are not used: the material of the scene counts",
                         context.where, "\"string group\" takes one group of the file");
    return FinishMesh(std::move(obj.mesh), context, "filename", settings.alpha);
  } catch (const ObjError& error) {
    throw ParamError{"filename", "cannot be used (" + settings.fileName + "): " + error.what(), ""};
  }
}

}  // namespace
}  // namespace exphoton

EXPHOTON_SHAPE("obj", "polygons from a Wavefront OBJ file")
