// SPDX-License-Identifier: BSD-2-Clause
// PicturePasses states the passes that a picture of shards consists of. They do not depend on the
// pixels of earlier passes, so each shard can render its share of all passes.
#pragma once

#include <memory>

#include "core/files/byte_archive.h"
#include "core/render/render.h"

namespace exphoton {

struct PicturePasses {
  enum class Kind { Single, TwoHalves, TargetError, Accuracy };
  // The rule of Kind::Accuracy, as in AccuracyRule.
  struct Accuracy {
    double error = 0, biasShare = 0, omitted = 0;
    double correctedShare = 0;  // of the gather rays; 0: the integrator has no bias
  };
  Kind kind = Kind::Single;
  int count = 1;
  double targetError = 0;  // noise part of relMSE, for Kind::TargetError
  Accuracy accuracy{};

  // Returns whether a rule decides how many of the passes belong to the picture.
  bool HasRule() const { return kind == Kind::TargetError || kind == Kind::Accuracy; }
  void Transfer(ByteArchive* archive);  // saves or loads

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
