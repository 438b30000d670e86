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

template <class Transfer>
void ShardWriter::AddTileSection(const char* what, const ShardTile& tile,
                                 const Transfer& transfer) {
  ByteArchive section;
  transfer(&section);
  file_->Add(TileSection(pass_, what, tile), section.Take());
}

void ShardWriter::AddTile(const ShardTile& tile, Film* film, const TileParts& parts) {
  AddTileSection(kTileSection, tile,
                 [&](ByteArchive* archive) { TransferTileFilm(archive, tile, film, parts.aovs); });
  if (parts.aovs && parts.aovs->NeedsTime())
    AddTileSection(kTimeSection, tile,
                   [&](ByteArchive* archive) { TransferTileTimes(archive, tile, parts.aovs); });
  if (parts.gathers)
    AddTileSection(kGatherSection, tile, [&](ByteArchive* archive) {
      TransferTileGathers(archive, tile, parts.gathers);
    });
  if (parts.corrections)
    AddTileSection(kCorrectionSection, tile, [&](ByteArchive* archive) {
      TransferTileCorrections(archive, tile, parts.corrections);
    });
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
