// SPDX-License-Identifier: BSD-2-Clause
// PicturePasses: the seeds are those of a render on one machine (render_halves.cpp,
// render_passes.cpp).
#include "core/render/shards/picture_passes.h"

#include <algorithm>

#include "core/render/passes/pass_parts.h"

namespace exphoton {

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
    if (!renderer.Run(pass.pass, *pass.sampler, &job.film)) break;
  }
  return renderer.Finish();
}

}  // namespace exphoton
