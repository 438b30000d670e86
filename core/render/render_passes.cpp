// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses: pass sizes, seeds and stopping rules.
#include "core/render/render_passes.h"

#include <algorithm>
#include <cmath>

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;

// The number of independent replicates of the picture. Passes are assigned to replicates in turn.
// The passes of one replicate continue the same sequences of camera samples, because longer
// sequences are better distributed.
constexpr int kReplicates = 8;
constexpr int kMinPasses = 2;        // needed for a noise estimate
constexpr std::int64_t kGrowth = 8;  // a pass adds at most 1/8 of the samples so far
constexpr std::int64_t kMaxPassSamples = 64;
constexpr std::uint64_t kPassSeed = 0x70617373ull, kReplicateSeed = 0x7265706cull;
constexpr std::int64_t kProgressSteps = 1000;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Passes {
 public:
  Passes(const RenderJob& job, const RenderOptions& options, const StoppingRule& rule)
      : job_(job),
        rule_(rule),
        options_(options),
        quiet_(ProgressReporter::Mode::Quiet),
        quietJob_{job.scene,   job.integrator, job.sampler, job.filter,     job.camera, job.film,
                  job.threads, job.log,        quiet_,      job.statistics, job.volume, job.integratorName},
        renderer_(quietJob_, options_),
        passFilm_(job.film.Full(), job.film.Crop()),
        noise_(job.film.Crop(), kReplicates),
        maxPassSamples_(
            std::clamp<std::int64_t>(job.sampler.SamplesPerPixel(), 1, kMaxPassSamples)) {
    if (job.sampler.IsProgressive())
      progressiveSampler_ = job.sampler.WithSamplesPerPixel(rule.maxSamples);
  }

  PassesResult Run() {
    job_.progress.Begin("Rendering", kProgressSteps);
    for (std::optional<StopReason> reason; !reason; reason = Reason()) {
      if (!RunPass(NextSize())) {
        result_.reason = StopReason::Signal;
        return Finish();
      }
      job_.progress.SetDone(Progress());
    }
    result_.reason = *reasonMet_;
    return Finish();
  }

 private:
  // Passes are small at first, so that rendering stops close to the target error. Later passes add
  // an eighth of the samples so far.
  std::int64_t NextSize() const {
    const std::int64_t total = result_.samplesPerPixel;
    const std::int64_t size = std::clamp<std::int64_t>(total / kGrowth, 1, maxPassSamples_);
    return std::min({size, SizeInTime(), rule_.maxSamples - total});
  }
  // Returns the pass size that the remaining time allows, judged by the times of the last pass.
  // Returns 0 if not even one sample fits.
  std::int64_t SizeInTime() const {
    if (!rule_.timeLimit || result_.passes == 0) return maxPassSamples_;
    const double left =
        *rule_.timeLimit - SecondsSince(rule_.start) - renderer_.PreprocessSeconds();
    const double each = renderer_.RenderSeconds() / double(lastSize_);
    return std::int64_t(
        std::clamp(std::floor(left / std::max(each, 1e-9)), 0., double(maxPassSamples_)));
  }

  bool RunPass(std::int64_t size) {
    const int replicate = noise_.SmallestGroup();
    RenderPass pass;
    pass.preprocessSeed = HashKey({options_.seed, kPassSeed, std::uint64_t(result_.passes)});
    pass.sampleCount = size;
    std::unique_ptr<Sampler> pattern;
    if (progressiveSampler_) {
      pass.sampleSeed = HashKey({options_.seed, kReplicateSeed, std::uint64_t(replicate)});
      pass.firstSample = noise_.SamplesOf(replicate);
    } else {
      // The pass uses a complete sample pattern with a separate seed.
      pass.sampleSeed = pass.preprocessSeed;
      pattern = job_.sampler.WithSamplesPerPixel(size);
    }
    passFilm_.Clear();
    const bool isWhole =
        renderer_.Run(pass, progressiveSampler_ ? *progressiveSampler_ : *pattern, &passFilm_);
    job_.film.Add(passFilm_);
    if (!isWhole) return false;
    noise_.Add(replicate, passFilm_, size);
    lastSize_ = size;
    ++result_.passes;
    result_.samplesPerPixel += size;
    if (result_.passes > 1 && rule_.targetError) result_.noise = noise_.RelativeVariance();
    return true;
  }

  std::optional<StopReason> Reason() {
    if (rule_.targetError && result_.passes >= kMinPasses && *result_.noise <= *rule_.targetError)
      reasonMet_ = StopReason::TargetError;
    else if (result_.samplesPerPixel >= rule_.maxSamples)
      reasonMet_ = StopReason::Samples;
    else if (rule_.timeLimit && SizeInTime() < 1)
      reasonMet_ = StopReason::TimeLimit;
    else if (options_.stop && *options_.stop)
      reasonMet_ = StopReason::Signal;
    return reasonMet_;
  }

  std::int64_t Progress() const {
    double done = double(result_.samplesPerPixel) / double(rule_.maxSamples);
    if (rule_.targetError && result_.noise)
      done = std::max(done, *rule_.targetError / *result_.noise);
    if (rule_.timeLimit) done = std::max(done, SecondsSince(rule_.start) / *rule_.timeLimit);
    return std::int64_t(double(kProgressSteps) * std::clamp(done, 0., 1.));
  }

  PassesResult Finish() {
    job_.progress.End();
    result_.render = renderer_.Finish();
    if (result_.passes > 1) {
      result_.noise = noise_.RelativeVariance();
      if (options_.aovs && options_.aovs->Wanted().Has(Aov::Variance))
        result_.variances = noise_.Variances();
    }
    if (result_.reason == StopReason::Signal) result_.render.isComplete = false;
    return std::move(result_);
  }

  const RenderJob& job_;
  const StoppingRule& rule_;
  RenderOptions options_;
  ProgressReporter quiet_;  // hides the phases of each pass, which would be many lines
  RenderJob quietJob_;
  PassRenderer renderer_;
  Film passFilm_;
  PassNoise noise_;
  std::int64_t maxPassSamples_, lastSize_ = 1;
  std::unique_ptr<Sampler> progressiveSampler_;  // null if the sampler is not progressive
  PassesResult result_;
  std::optional<StopReason> reasonMet_;
};

}  // namespace

const char* StopReasonName(StopReason reason) {
  switch (reason) {
    case StopReason::Samples:
      return "samples";
    case StopReason::TargetError:
      return "target-error";
    case StopReason::TimeLimit:
      return "time-limit";
    case StopReason::Signal:
      return "signal";
  }
  return "";
}

PassesResult RenderInPasses(const RenderJob& job, const RenderOptions& options,
                            const StoppingRule& rule) {
  return Passes(job, options, rule).Run();
}

PassesResult RenderTwoHalves(const RenderJob& job, const RenderOptions& options, Film* first,
                             Film* second) {
  const std::int64_t count = std::max<std::int64_t>((job.sampler.SamplesPerPixel() + 1) / 2, 1);
  const std::unique_ptr<Sampler> sampler = job.sampler.WithSamplesPerPixel(count);
  const std::int64_t samples = sampler->SamplesPerPixel();
  PassRenderer renderer(job, options);
  PassNoise noise(job.film.Crop(), 2);
  PassesResult result;
  bool isWhole = true;
  for (Film* half : {first, second}) {
    if (!isWhole) break;
    const std::uint64_t seed = HashKey({options.seed, kPassSeed, std::uint64_t(result.passes)});
    isWhole = renderer.Run({seed, seed, 0, samples}, *sampler, half);
    job.film.Add(*half);
    if (!isWhole) break;
    noise.Add(result.passes++, *half, samples);
    result.samplesPerPixel += samples;
  }
  result.render = renderer.Finish();
  if (!isWhole) result.reason = StopReason::Signal;
  if (result.passes == 2) result.noise = noise.RelativeVariance();
  if (result.passes == 2 && options.aovs && options.aovs->Wanted().Has(Aov::Variance))
    result.variances = noise.Variances();
  return result;
}

}  // namespace exphoton
