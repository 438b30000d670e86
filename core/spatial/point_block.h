// SPDX-License-Identifier: BSD-2-Clause
// Points in blocks of sixteen, one coordinate after the other, so that a block's distances are
// computed several at a time. Each has a unit direction: where a photon came from, or the normal of
// what lies there.
#pragma once

#include <cstdint>

#include "core/math/octahedral.h"

namespace exphoton {

inline constexpr std::uint32_t kBlockPoints = 16;

struct OrientedPoint {
  Point3 p;
  std::uint32_t direction = 0;  // EncodeOctahedral
};

// Sources of other things that belong to points derive from it. Aligned as a row is long: a block
// then takes the room of its sixteen records, whatever Real is. Where there are fewer than sixteen
// points, the last one is repeated: searches know how many there are, and compute with nothing but
// finite numbers.
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

}  // namespace exphoton
