// SPDX-License-Identifier: BSD-2-Clause
// Loop subdivision at a vertex of the boundary, in dependence on the number of faces that meet
// there.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

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

// The tangent mask of the boundary is an eigenvector of the subdivision, for any number of faces:
// the limit's normal is the same at every level.
TEST(LoopSubdivision, NormalsOfAFanDoNotDependOnTheLevel) {
  for (std::uint32_t faces = 1; faces <= 8; ++faces) {
    SubdivisionMesh fan;
    fan.positions.push_back({0, 0, .3});
    for (std::uint32_t i = 0; i <= faces; ++i) {
      const double angle = M_PI * i / faces;
      fan.positions.push_back(
          {std::cos(angle) * (1 + .1 * i), std::sin(angle) + .2, .4 * std::sin(2. * i) + .2 * i});
      if (i > 0) fan.faces.push_back({0, i, i + 1});
    }
    const LimitMesh coarse = LoopSubdivide(fan, 0);
    for (const int level : {1, 3}) {
      const LimitMesh fine = LoopSubdivide(fan, level);
      EXPECT_GT(Dot(fine.normals[0], coarse.normals[0]), 1 - 1e-9) << faces << " " << level;
      EXPECT_LT(Length(fine.mesh.positions[0] - coarse.mesh.positions[0]), 1e-12) << faces;
    }
  }
}

// The n neighbours of a vertex are ordered in n log n steps. A search among all of them for each
// one takes 5 10^9 steps here.
TEST(LoopSubdivision, OfAWheelOfManySpokesIsFast) {
  constexpr std::uint32_t kSpokes = 100000;
  SubdivisionMesh wheel;
  wheel.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 0; i < kSpokes; ++i) {
    const double angle = 2 * M_PI * i / kSpokes;
    wheel.positions.push_back({std::cos(angle), std::sin(angle), 0});
    // The order of the faces is not the order of the neighbours.
    const std::uint32_t first = std::uint32_t(std::uint64_t(i) * 7919 % kSpokes);
    wheel.faces.push_back({0, 1 + first, 1 + (first + 1) % kSpokes});
  }
  const std::clock_t start = std::clock();  // CPU time
  const LimitMesh limit = LoopSubdivide(wheel, 0);
  EXPECT_LT(std::clock() - start, 4 * CLOCKS_PER_SEC);
  EXPECT_NEAR(limit.normals[0].z, 1, 1e-12);
  EXPECT_EQ(limit.mesh.faces.size(), kSpokes);
}

}  // namespace
}  // namespace exphoton
