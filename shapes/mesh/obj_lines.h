// SPDX-License-Identifier: BSD-2-Clause
// CheckObjLines reads an OBJ file line by line before the library parses it: the library takes
// wrong numbers for 0, and its memory follows counts that a file claims.
#pragma once

#include <string>
#include <string_view>

#include "shapes/mesh/obj_reader.h"

namespace exphoton {

struct ObjLines {
  std::string text;  // the vertices and the chosen faces alone, checked
  bool namesMaterials = false;
};

// `group` as in ParseObj. Throws ObjError with the number of a line where the file is wrong.
ObjLines CheckObjLines(std::string_view bytes, const std::string& group);

}  // namespace exphoton
