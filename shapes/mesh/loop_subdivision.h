// SPDX-License-Identifier: BSD-2-Clause
// LoopSubdivide applies Loop subdivision to a triangle mesh with boundaries, and ends on the limit
// surface with its exact normals. Positions are in double precision. Sources: Loop 1987; Warren's
// weights; limit and tangent masks: Hoppe et al. 1994; Biermann, Levin and Zorin 2000.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/geometry/vec3d.h"

namespace exphoton {

struct SubdivisionMesh {
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<Vec3d> positions;
};

struct LimitMesh {
  SubdivisionMesh mesh;        // vertices on the limit surface
  std::vector<Vec3d> normals;  // unit, on the winding's side; 0 if undefined
};

// Returns whether no edge has more than two faces and no face names a vertex twice.
bool IsManifold(const SubdivisionMesh& mesh);

// IsManifold(mesh) must hold.
LimitMesh LoopSubdivide(SubdivisionMesh mesh, int levels);

}  // namespace exphoton
