// SPDX-License-Identifier: BSD-2-Clause
// What every shape that makes a mesh ends with: to world space, checks, and one warning about what
// was dropped or replaced. Reading and index checks come before.
#pragma once

#include <memory>
#include <string>

#include "core/plugins/kinds.h"

namespace exphoton {

// `mesh` is in object space; positions must be finite there. Throws ParamError about
// `positionParam` where the transformation makes one that is not.
std::unique_ptr<ShapeGeometry> FinishMesh(std::unique_ptr<TriangleMesh> mesh,
                                          const ShapeContext& context,
                                          const std::string& positionParam);

// Throws ParamError{param} unless indices come in threes and each names one of `vertexCount`.
std::vector<std::array<std::uint32_t, 3>> CheckedTriangles(const std::vector<int>& indices,
                                                           std::size_t vertexCount,
                                                           const std::string& param);

}  // namespace exphoton
