// SPDX-License-Identifier: BSD-2-Clause
// ReadObj reads the polygons of a Wavefront OBJ file into a triangle mesh. Materials, lines, points
// and smoothing groups are skipped. Source: "Object Files (.obj)", appendix B1 of the Advanced
// Visualizer manual.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/geometry/triangle_mesh.h"

namespace exphoton {

struct ObjError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct ObjMesh {
  std::unique_ptr<TriangleMesh> mesh;  // in the coordinates of the file
  bool namesMaterials = false;
};

// Takes the faces of one group or object, or all if `group` is empty. Groups and objects are
// independent: an object may begin within a group, and a group within an object. OBJ counts texture
// coordinates from the lower edge of a picture; here v is 0 at the top. Throws ObjError with a
// sentence as its message.
ObjMesh ParseObj(std::string_view bytes, const std::string& group);
ObjMesh ReadObj(const std::string& path, const std::string& group);

}  // namespace exphoton
