// SPDX-License-Identifier: BSD-2-Clause
// These functions save and load the sections of a part, the file that holds the sums of one shard.
// docs/development/state-files.md describes the format.
#pragma once

#include <string>

#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"
#include "core/render/certificate/corrections.h"
#include "core/render/shards/shard_tiles.h"
#include "core/render/sharing/gather_fragments.h"

namespace exphoton {

// ShardLayout describes the picture that a part belongs to.
struct ShardLayout {
  Shard shard;
  PixelBounds full, crop;
  AovSet aovs;
  std::int64_t samplesPerPixel = 1;  // of one pass
  int passes = 1;
  bool isShared = false, isSplatted = false;

  void Transfer(ByteArchive* archive);  // saves or loads
};

// The names of sections: "shard", "pass 0 tile 17", "pass 0 totals".
inline constexpr const char* kShardSection = "shard";
inline constexpr const char* kTileSection = "tile";
inline constexpr const char* kTimeSection = "times of tile";
inline constexpr const char* kGatherSection = "gathers of tile";
inline constexpr const char* kCorrectionSection = "corrections of tile";
std::string PassSection(int pass, const std::string& what);
std::string TileSection(int pass, const std::string& what, const ShardTile& tile);

// Each function saves or loads the pixels of a tile. Pixels outside the film have gathers only.
void TransferTileFilm(ByteArchive* archive, const ShardTile& tile, Film* film, AovFilm* aovs);
void TransferTileCorrections(ByteArchive* archive, const ShardTile& tile, Corrections* corrections);
void TransferTileTimes(ByteArchive* archive, const ShardTile& tile, AovFilm* aovs);
// Rows outside the bounds of `gathers` are read and left out.
void TransferTileGathers(ByteArchive* archive, const ShardTile& tile, GatherFragments* gathers);

}  // namespace exphoton
