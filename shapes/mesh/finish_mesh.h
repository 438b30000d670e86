// SPDX-License-Identifier: BSD-2-Clause
// FinishMesh is the last step of every shape that makes a mesh: it moves the mesh to world space,
// checks it, and gives one warning about dropped or replaced data. Callers read the data and check
// indices. CheckTriangleCount and CheckMemory refuse a mesh before the work on it begins.
#pragma once

#include <memory>
#include <string>

#include "core/plugins/kinds.h"

namespace exphoton {

// `mesh` is in object space and has finite positions. Throws ParamError about `positionParam` if
// the transformation makes a position that is not finite. The mesh has holes where `alpha` is 0;
// null: it has none. A constant alpha is dropped: the mesh is whole, or it has no triangles.
std::unique_ptr<ShapeGeometry> FinishMesh(std::unique_ptr<TriangleMesh> mesh,
                                          const ShapeContext& context,
                                          const std::string& positionParam,
                                          const std::shared_ptr<const Texture<Real>>& alpha = {});

// Returns the triangles. Throws ParamError{param} unless indices come in threes and each names one
// of `vertexCount` vertices.
std::vector<std::array<std::uint32_t, 3>> CheckedTriangles(const std::vector<int>& indices,
                                                           std::size_t vertexCount,
                                                           const std::string& param);

// Throws ParamError{param} if a mesh would have too many triangles.
void CheckTriangleCount(double count, const std::string& param);

// Throws an Error if the memory of this process is less than `bytes`. A system that runs out of
// memory may end other programs. `subject` begins the message.
void CheckMemory(double bytes, const std::string& subject, const std::string& hint,
                 const SourceLocation& where);

}  // namespace exphoton
