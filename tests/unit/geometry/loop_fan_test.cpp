// SPDX-License-Identifier: BSD-2-Clause
// Loop subdivision at a vertex of the boundary, in dependence on the number of faces that meet
// there.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes/mesh/loop_subdivision.h"

namespace exphoton {
namespace {

// Half a wheel: many faces meet at one vertex of the boundary.
TEST(LoopSubdivision, ABoundaryVertexOfManyFacesFacesAsTheyDo) {
  for (const std::uint32_t faces : {1u, 2u, 3u, 4u, 6u}) {
    SubdivisionMesh fan;
    fan.positions.push_back({0, 0, 0});
    for (std::uint32_t i = 0; i <= faces; ++i) {
      const double angle = M_PI * i / faces;
      fan.positions.push_back({std::cos(angle), std::sin(angle) + .2, 0});
      if (i > 0) fan.faces.push_back({0, i, i + 1});
    }
    for (const int level : {0, 2})
      EXPECT_NEAR(LoopSubdivide(fan, level).normals[0].z, 1, 1e-12) << faces << " " << level;
  }
}

}  // namespace
}  // namespace exphoton
