// SPDX-License-Identifier: BSD-2-Clause
// MergeShards adds up the parts of a picture. Each pixel gets the same sums in the same order as in
// a render on one machine, so the result has the same bits.
#pragma once

#include <vector>

#include "core/files/state_file.h"
#include "core/render/passes/render_passes.h"
#include "core/render/render_totals.h"
#include "core/render/shards/picture_passes.h"
#include "core/render/shards/shard_sections.h"
#include "core/render/splat_weights.h"

namespace exphoton {

struct ShardMerge {
  std::vector<const StateFile*> parts;  // all parts, by index
  ShardLayout layout;                   // of the picture; the shard has no meaning
  PicturePasses passes;
  const SplatWeights* splatWeights = nullptr;  // required if samples are splatted
  double sharingMemory = 0x1p28;               // as in RenderOptions
};

// The films of the whole picture.
struct MergedFilms {
  Film* film;
  AovFilm* aovs = nullptr;  // null: none
  Film* halves[2] = {};     // for Kind::TwoHalves
  // For Kind::Accuracy, with the share of PicturePasses. Null: the integrator has no bias.
  Corrections* corrections = nullptr;
};

// Fills the films. `summary` receives statistics and warnings. Throws Error(File) if a section of a
// part is missing or does not fit.
PassesResult MergeShards(const ShardMerge& merge, const MergedFilms& films,
                         const SummaryTarget& summary, ThreadPool* threads);

}  // namespace exphoton
