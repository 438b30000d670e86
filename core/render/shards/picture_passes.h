// SPDX-License-Identifier: BSD-2-Clause
// PicturePasses states the passes that a picture of shards consists of. They do not depend on the
// pixels of earlier passes, so each shard can render its share of all passes.
#pragma once

#include <memory>

#include "core/files/byte_archive.h"
#include "core/render/render.h"

namespace exphoton {

struct PicturePasses {
  enum class Kind { Single, TwoHalves, TargetError };
  Kind kind = Kind::Single;
  int count = 1;
  double targetError = 0;  // noise part of relMSE, for Kind::TargetError

  void Transfer(ByteArchive* archive) {  // saves or loads
    int number = int(kind);
    archive->Values(&number, &count, &targetError);
    if (number < 0 || number > int(Kind::TargetError) || count < 1)
      throw ArchiveError("its passes contradict each other");
    kind = Kind(number);
  }

  struct Pass {
    RenderPass pass;
    std::unique_ptr<Sampler> sampler;
  };
  // `sampler` is the picture's.
  Pass Get(int number, std::uint64_t seed, const Sampler& sampler) const;
};

// Renders the job's share of all passes to the writer in `options`. The job's film and AOVs hold
// one pass at a time.
RenderResult RenderShard(const RenderJob& job, const RenderOptions& options,
                         const PicturePasses& passes);

}  // namespace exphoton
