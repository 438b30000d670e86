// SPDX-License-Identifier: BSD-2-Clause
// PointBlock stores sixteen oriented points as a structure of arrays, so that SIMD instructions
// compute several distances at a time. Each point has a unit direction: the direction towards a
// photon's origin, or the surface normal of a radiance photon.
#pragma once

#include <cstdint>

#include "core/math/octahedral.h"

namespace exphoton {

inline constexpr std::uint32_t kBlockPoints = 16;

struct OrientedPoint {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral
};

// Blocks with further data per point derive from this struct. The alignment is the size of one row,
// so that a block is exactly as large as its sixteen records, in single and in double precision. A
// block with fewer than sixteen points repeats the last one, so that all lanes hold finite numbers.
// Searches mask the padding lanes by the number of points.
struct alignas(kBlockPoints * sizeof(Real)) PointBlock {
  using Record = OrientedPoint;

  Real x[kBlockPoints], y[kBlockPoints], z[kBlockPoints];
  std::uint32_t direction[kBlockPoints];

  Point3 Position(std::uint32_t lane) const { return {x[lane], y[lane], z[lane]}; }
  Vector3 Direction(std::uint32_t lane) const { return DecodeOctahedral(direction[lane]); }
  void Set(std::uint32_t lane, const OrientedPoint& point) {
    x[lane] = point.p.x;
    y[lane] = point.p.y;
    z[lane] = point.p.z;
    direction[lane] = point.direction;
  }
};

// A block of points that are disks.
struct DiskBlock : PointBlock {
  Real radius2[kBlockPoints];  // squared radii: a disk covers the positions within its radius
};

}  // namespace exphoton
