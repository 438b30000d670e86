// SPDX-License-Identifier: BSD-2-Clause
// A shard is the share of a picture that one process renders. The picture is divided into tiles
// that are numbered along a Morton curve. Shard i of n renders the tiles i - 1, i - 1 + n, ..., so
// that each shard has tiles in all parts of the picture and costs are about equal.
#pragma once

#include <cstdint>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton {

struct Shard {
  int index = 1, count = 1;  // 1 <= index <= count

  static constexpr int kMaxCount = 100000;
};

struct ShardTile {
  std::int64_t number = 0;  // along the Morton curve, from 0
  PixelBounds bounds;

  // Returns the index of the shard that renders the tile.
  int ShardOf(int count) const { return int(number % count) + 1; }
};

inline constexpr int kShardTileSize = 16;  // pixels

// Returns all tiles of a window of pixels, from the top row of tiles to the bottom one.
std::vector<ShardTile> ShardTiles(const PixelBounds& window);

// Returns the tiles of one shard, in the same order.
std::vector<ShardTile> TilesOf(const Shard& shard, const PixelBounds& window);

std::int64_t CountPixels(const std::vector<ShardTile>& tiles);

}  // namespace exphoton
