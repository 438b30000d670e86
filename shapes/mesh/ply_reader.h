// SPDX-License-Identifier: BSD-2-Clause
// ReadPly reads a PLY file ("Stanford polygon format" 1.0: ascii, or binary of either byte order,
// optionally compressed by gzip) into a triangle mesh. Other elements and properties are skipped.
// Source: Turk 1994, "The PLY Polygon File Format".
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/geometry/triangle_mesh.h"

namespace exphoton {

struct PlyError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Reads vertices x y z, with nx ny nz and u v (or s t, texture_u ...) if all of them are given.
// Faces have three or four corners; quads are cut along corners 0 and 2. Throws PlyError with a
// sentence as its message.
std::unique_ptr<TriangleMesh> ParsePly(std::string_view bytes);

// Does the same for a file. `mostBytes` limits the decompressed size, because a small compressed
// file can fill any memory. 0: half of the memory that this process may use, at most 8 GiB.
std::unique_ptr<TriangleMesh> ReadPly(const std::string& path, std::uint64_t mostBytes = 0);

}  // namespace exphoton
