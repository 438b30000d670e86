// SPDX-License-Identifier: BSD-2-Clause
// The geometry of the benchmarks: a closed room with a crowd of bumpy bodies, of as many triangles
// as wanted, and the rays that a renderer traces in it. Made by formula, without files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/aggregate.h"

namespace exphoton {

// "266k", "1M", ...: about as many triangles.
std::size_t TriangleCountOf(const std::string& size);

// A room of 8 x 4 x 6 with twelve bodies that share the triangles.
std::unique_ptr<PrimitiveSet> BenchmarkRoom(std::size_t triangles);

// The same room with seven boxes instead: 96 triangles.
std::unique_ptr<PrimitiveSet> SmallRoom();

// About `count` rays each.
struct RaySets {
  std::vector<Ray> primary;       // of a pinhole camera, in scanlines
  std::vector<Ray> firstBounce;   // from where these hit, by the cosine; in the same order
  std::vector<Ray> secondBounce;  // from where those hit; shuffled
  std::vector<Ray> gather;        // 32 by the cosine from one first hit after the other
  std::vector<Ray> shadow;        // segments from the first hits to a light under the ceiling
};
RaySets MakeRaySets(const PrimitiveSet& room, const Aggregate& accelerator, std::size_t count);

}  // namespace exphoton
