// SPDX-License-Identifier: BSD-2-Clause
// ShardTiles sorts tiles by their Morton codes to number them.
#include "core/render/shards/shard_tiles.h"

#include <algorithm>

namespace exphoton {
namespace {

// Interleaves the bits of two numbers.
std::uint64_t MortonCode(std::uint32_t x, std::uint32_t y) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 32; ++bit) {
    code |= std::uint64_t(x >> bit & 1u) << (2 * bit);
    code |= std::uint64_t(y >> bit & 1u) << (2 * bit + 1);
  }
  return code;
}

}  // namespace

std::vector<ShardTile> ShardTiles(const PixelBounds& window) {
  std::vector<ShardTile> tiles;
  for (int y = window.y0; y < window.y1; y += kShardTileSize)
    for (int x = window.x0; x < window.x1; x += kShardTileSize)
      tiles.push_back({0,
                       {x, y, std::min(x + kShardTileSize, window.x1),
                        std::min(y + kShardTileSize, window.y1)}});
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const PixelBounds& tile = tiles[i].bounds;
    order.emplace_back(MortonCode(std::uint32_t(tile.x0 - window.x0) / kShardTileSize,
                                  std::uint32_t(tile.y0 - window.y0) / kShardTileSize),
                       i);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t number = 0; number < order.size(); ++number)
    tiles[order[number].second].number = std::int64_t(number);
  return tiles;
}

std::vector<ShardTile> TilesOf(const Shard& shard, const PixelBounds& window) {
  std::vector<ShardTile> tiles = ShardTiles(window);
  std::erase_if(tiles,
                [&](const ShardTile& tile) { return tile.ShardOf(shard.count) != shard.index; });
  return tiles;
}

std::int64_t CountPixels(const std::vector<ShardTile>& tiles) {
  std::int64_t pixels = 0;
  for (const ShardTile& tile : tiles)
    pixels += std::int64_t(tile.bounds.Width()) * tile.bounds.Height();
  return pixels;
}

}  // namespace exphoton
