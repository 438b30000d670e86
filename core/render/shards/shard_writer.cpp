// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/shards/shard_writer.h"

#include "core/render/shards/shard_statistics.h"
#include "core/render/state/checkpoints.h"

namespace exphoton {

void ShardWriter::BeginPass(ShardLayout layout) {
  if (++pass_ > 0) return;
  layout.shard = shard_;
  layout.passes = passes_;
  SaveSection(kShardSection, layout, file_);
}

void ShardWriter::AddTile(const ShardTile& tile, Film* film, AovFilm* aovs,
                          GatherFragments* gathers) {
  ByteArchive sums;
  TransferTileFilm(&sums, tile, film, aovs);
  file_->Add(TileSection(pass_, "tile", tile), sums.Take());
  if (aovs && aovs->NeedsTime()) {
    ByteArchive times;
    TransferTileTimes(&times, tile, aovs);
    file_->Add(TileSection(pass_, "times of tile", tile), times.Take());
  }
  if (!gathers) return;
  ByteArchive gathered;
  TransferTileGathers(&gathered, tile, gathers);
  file_->Add(TileSection(pass_, "gathers of tile", tile), gathered.Take());
}

void ShardWriter::AddSplats(const SplatBuffer& splats, const PixelBounds& crop) {
  for (int y = crop.y0; y < crop.y1; ++y) {
    ByteArchive row;
    splats.SaveRow(&row, y);
    file_->Add(PassSection(pass_, "splats of row " + std::to_string(y)), row.Take());
  }
}

void ShardWriter::EndPass(const Statistics& statistics, RenderTotals totals,
                          NonFiniteLog* nonFinite) {
  SaveSection(PassSection(pass_, "totals").c_str(), totals, file_);
  SaveSection(PassSection(pass_, "non-finite samples").c_str(), *nonFinite, file_);
  ShardStatistics counts(statistics);
  SaveSection(PassSection(pass_, "statistics").c_str(), counts, file_);
}

}  // namespace exphoton
