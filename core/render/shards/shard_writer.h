// SPDX-License-Identifier: BSD-2-Clause
// ShardWriter writes the sums of one shard to the sections of a state file, pass by pass and tile
// by tile, so that tiles need not stay in memory.
#pragma once

#include "core/base/statistics.h"
#include "core/files/state_file.h"
#include "core/render/render_totals.h"
#include "core/render/shards/shard_sections.h"
#include "core/render/splat_buffer.h"

namespace exphoton {

class ShardWriter {
 public:
  // The render will have this number of passes. `file` must outlive this object.
  ShardWriter(const Shard& shard, int passes, StateWriter* file)
      : shard_(shard), passes_(passes), file_(file) {}

  const Shard& Of() const { return shard_; }

  // `layout` need not have the shard and the number of passes.
  void BeginPass(ShardLayout layout);
  // What a tile of a pass has besides its light. Each part may be null.
  struct TileParts {
    AovFilm* aovs = nullptr;
    GatherFragments* gathers = nullptr;
    Corrections* corrections = nullptr;
  };
  void AddTile(const ShardTile& tile, Film* film, const TileParts& parts);
  void AddSplats(const SplatBuffer& splats, const PixelBounds& crop);
  // Adds counts and times of all passes so far.
  void EndPass(const Statistics& statistics, RenderTotals totals, NonFiniteLog* nonFinite);

 private:
  // Adds a section of a tile, which `transfer` saves.
  template <class Transfer>
  void AddTileSection(const char* what, const ShardTile& tile, const Transfer& transfer);

  Shard shard_;
  int passes_, pass_ = -1;
  StateWriter* file_;
};

}  // namespace exphoton
