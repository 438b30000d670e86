// SPDX-License-Identifier: BSD-2-Clause
// Reads a PLY file ("Stanford polygon format" 1.0: ascii, binary of either byte order, compressed
// by gzip or not) to a mesh of triangles. Other elements and properties are skipped. Source: Turk
// 1994, "The PLY Polygon File Format".
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

// Vertices x y z, with nx ny nz and u v (or s t, texture_u ...) where all are given; faces of three
// or four corners, the latter cut along corners 0 and 2. Throws PlyError with a sentence.
std::unique_ptr<TriangleMesh> ParsePly(std::string_view bytes);

// The same from a file. `mostBytes` limits the decompressed size, because a small compressed file
// can fill any memory; 0: half of the memory that this process may use, and at most 8 GiB.
std::unique_ptr<TriangleMesh> ReadPly(const std::string& path, std::uint64_t mostBytes = 0);

}  // namespace exphoton
