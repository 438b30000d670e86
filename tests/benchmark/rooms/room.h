// SPDX-License-Identifier: BSD-2-Clause
// BenchmarkRoom is the geometry of the benchmarks: a closed room with bumpy bodies, with a chosen
// number of triangles. MakeRaySets returns the rays that a renderer traces in the room. Formulas
// define both, without files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/scene/aggregate.h"

namespace exphoton {

// Converts "266k", "1M", ... to an approximate number of triangles.
std::size_t TriangleCountOf(const std::string& size);

// Returns a room of 8 x 4 x 6 whose twelve bodies share the triangles.
std::unique_ptr<PrimitiveSet> BenchmarkRoom(std::size_t triangles);

// Returns the same room with seven boxes instead: 96 triangles.
std::unique_ptr<PrimitiveSet> SmallRoom();

// RaySets holds about `count` rays of each kind.
struct RaySets {
  std::vector<Ray> primary;       // of a pinhole camera, in scanlines
  std::vector<Ray> firstBounce;   // from the primary hits, cosine-distributed; in the same order
  std::vector<Ray> secondBounce;  // from the firstBounce hits, cosine-distributed; shuffled
  std::vector<Ray> gather;        // 32 cosine-distributed rays from each of some primary hits
  std::vector<Ray> shadow;        // segments from the primary hits to a light under the ceiling
};
RaySets MakeRaySets(const PrimitiveSet& room, const Aggregate& accelerator, std::size_t count);

}  // namespace exphoton
