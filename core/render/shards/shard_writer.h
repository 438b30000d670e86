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
  // The AOVs and the gathers may be null.
  void AddTile(const ShardTile& tile, Film* film, AovFilm* aovs, GatherFragments* gathers);
  void AddSplats(const SplatBuffer& splats, const PixelBounds& crop);
  // Adds counts and times of all passes so far.
  void EndPass(const Statistics& statistics, RenderTotals totals, NonFiniteLog* nonFinite);

 private:
  Shard shard_;
  int passes_, pass_ = -1;
  StateWriter* file_;
};

}  // namespace exphoton
