// SPDX-License-Identifier: BSD-2-Clause
// PicturePasses: the seeds are those of a render on one machine (render_halves.cpp,
// render_passes.cpp).
#include "core/render/shards/picture_passes.h"

#include <algorithm>
#include <cmath>

#include "core/render/certificate/corrections.h"
#include "core/render/passes/pass_parts.h"

namespace exphoton {
namespace {

bool IsPossible(const PicturePasses::Accuracy& accuracy) {
  const auto isShare = [](double share) { return share >= 0 && share <= 1; };
  return accuracy.error > 0 && std::isfinite(accuracy.error) && accuracy.omitted >= 0 &&
         accuracy.omitted < accuracy.error && isShare(accuracy.biasShare) &&
         isShare(accuracy.correctedShare);
}

}  // namespace

void PicturePasses::Transfer(ByteArchive* archive) {
  int number = int(kind);
  archive->Values(&number, &count, &targetError);
  archive->Values(&accuracy.error, &accuracy.biasShare, &accuracy.omitted,
                  &accuracy.correctedShare);
  const bool isKnown = number >= 0 && number <= int(Kind::Accuracy) && count >= 1;
  const bool hasAccuracy = number == int(Kind::Accuracy);
  if (!isKnown || (hasAccuracy ? !IsPossible(accuracy) : accuracy.correctedShare != 0))
    throw ArchiveError("its passes contradict each other");
  kind = Kind(number);
}

PicturePasses::Pass PicturePasses::Get(int number, std::uint64_t seed,
                                       const Sampler& sampler) const {
  const std::int64_t samples = sampler.SamplesPerPixel();
  const auto group = std::uint64_t(number);
  Pass pass;
  switch (kind) {
    case Kind::Single:
      pass.pass = {seed, seed, 0, samples};
      break;
    case Kind::TwoHalves: {
      const std::uint64_t half = HashKey({seed, kPassSeed, group});
      pass.pass = {half, half, 0, std::max<std::int64_t>((samples + 1) / 2, 1)};
      break;
    }
    case Kind::TargetError:
    case Kind::Accuracy:
      pass.pass = PatternPass(seed, group, 0, samples);
      break;
  }
  pass.sampler = sampler.WithSamplesPerPixel(pass.pass.sampleCount);
  pass.pass.sampleCount = pass.sampler->SamplesPerPixel();
  return pass;
}

RenderResult RenderShard(const RenderJob& job, const RenderOptions& options,
                         const PicturePasses& passes) {
  PassRenderer renderer(job, options);
  for (int number = 0; number < passes.count; ++number) {
    const PicturePasses::Pass pass = passes.Get(number, options.seed, job.sampler);
    job.film.Clear();
    if (options.aovs) options.aovs->Clear();
    if (options.corrections) options.corrections->ClearPass();
    if (!renderer.Run(pass.pass, *pass.sampler, &job.film)) break;
  }
  return renderer.Finish();
}

}  // namespace exphoton
