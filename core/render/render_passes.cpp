// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses: pass sizes, seeds and stopping rules.
#include "core/render/render_passes.h"

#include <algorithm>
#include <atomic>

#include "core/render/pass_plan.h"

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;

// Groups of passes are independent of each other. Later groups share the places of the first ones,
// which limits memory.
constexpr int kGroups = 8;
constexpr std::uint64_t kPassSeed = 0x70617373ull, kGroupSeed = 0x7265706cull;
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
        quietJob_{job.scene,  job.integrator, job.sampler, job.filter,
                  job.camera, job.film,       job.threads, job.log,
                  quiet_,     job.statistics, job.volume,  job.integratorName},
        renderer_(quietJob_, options_),
        passFilm_(job.film.Full(), job.film.Crop()),
        noise_(job.film.Crop(), kGroups),
        forecast_(job.film.Crop()),
        plan_({rule.targetError, rule.timeLimit, rule.maxSamples}) {
    if (job.sampler.IsProgressive())
      progressiveSampler_ = job.sampler.WithSamplesPerPixel(rule.maxSamples);
    quiet_.SetListener([this] { ShowProgress(); });
  }

  PassesResult Run() {
    begin_ = Clock::now();
    job_.progress.Begin("Rendering", kProgressSteps);
    PassPlan::Step step = plan_.Next({});
    for (std::optional<StopReason> reason; !reason; reason = Reason(step)) {
      if (!RunPass(step)) {
        result_.reason = StopReason::Signal;
        return Finish();
      }
      const PassPlan::State state = State();
      step = plan_.Next(state);
      if (const auto left = plan_.SecondsLeft(state))
        expectedSeconds_ = SecondsSince(begin_) + *left;
    }
    result_.reason = *reasonMet_;
    return Finish();
  }

 private:
  PassPlan::State State() const {
    PassPlan::State state;
    state.samples = result_.samplesPerPixel;
    state.noise = result_.noise;
    if (rule_.targetError) state.enough = forecast_.SamplesFor(2 * *rule_.targetError);
    state.elapsed = rule_.timeLimit ? SecondsSince(rule_.start) : 0;
    state.preprocess = preprocessSeconds_;
    state.sample = renderSeconds_ / double(std::max<std::int64_t>(result_.samplesPerPixel, 1));
    return state;
  }

  bool RunPass(const PassPlan::Step& step) {
    if (step.isNewGroup) groupSamples_ = 0;
    const std::uint64_t group = std::uint64_t(plan_.Groups() - (step.isNewGroup ? 0 : 1));
    RenderPass pass;
    pass.preprocessSeed = HashKey({options_.seed, kPassSeed, group});
    pass.sampleCount = step.size;
    std::unique_ptr<Sampler> pattern;
    const bool goesOn = progressiveSampler_ && !step.isPattern;
    if (goesOn) {
      pass.sampleSeed = HashKey({options_.seed, kGroupSeed, group});
      pass.firstSample = groupSamples_;
    } else {
      // The pass uses a complete sample pattern with a separate seed.
      const auto first = std::uint64_t(groupSamples_);
      pass.sampleSeed = HashKey({options_.seed, kGroupSeed, group, first, kPassSeed});
      pattern = job_.sampler.WithSamplesPerPixel(step.size);
    }
    passFilm_.Clear();
    const bool isWhole = renderer_.Run(pass, goesOn ? *progressiveSampler_ : *pattern, &passFilm_);
    job_.film.Add(passFilm_);
    if (isWhole) TakePass(step, int(group % kGroups));
    return isWhole;
  }

  void TakePass(const PassPlan::Step& step, int group) {
    plan_.Take(step);
    noise_.Add(group, passFilm_, step.size);
    if (plan_.Groups() == 1 && rule_.targetError) forecast_.Add(passFilm_, step.size);
    if (plan_.Groups() == 2) forecast_.Release();
    if (step.isNewGroup) preprocessSeconds_ = renderer_.PreprocessSeconds();
    renderSeconds_ += renderer_.RenderSeconds();
    groupSamples_ += step.size;
    ++result_.passes;
    result_.samplesPerPixel += step.size;
    if (plan_.Groups() > 1 && rule_.targetError) result_.noise = noise_.RelativeVariance();
  }

  // `next` is the step that would follow.
  std::optional<StopReason> Reason(const PassPlan::Step& next) {
    if (rule_.targetError && result_.noise && *result_.noise <= *rule_.targetError)
      reasonMet_ = StopReason::TargetError;
    else if (result_.samplesPerPixel >= rule_.maxSamples)
      reasonMet_ = StopReason::Samples;
    else if (rule_.timeLimit && next.size < 1)
      reasonMet_ = StopReason::TimeLimit;
    else if (options_.stop && *options_.stop)
      reasonMet_ = StopReason::Signal;
    return reasonMet_;
  }

  // Shows the share of the expected time, so that the bar moves within passes.
  void ShowProgress() {
    const double expected = expectedSeconds_.load(std::memory_order_relaxed);
    if (!(expected > 0)) return;
    const double done = std::min(SecondsSince(begin_) / expected, .99);
    job_.progress.SetDone(std::int64_t(double(kProgressSteps) * done));
  }

  PassesResult Finish() {
    if (result_.reason != StopReason::Signal) job_.progress.SetDone(kProgressSteps);
    job_.progress.End();
    result_.render = renderer_.Finish();
    if (plan_.Groups() > 1) {
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
  PassNoise noise_;  // by group
  GroupForecast forecast_;
  PassPlan plan_;
  std::int64_t groupSamples_ = 0;
  double preprocessSeconds_ = 0, renderSeconds_ = 0;  // of one group, and of all passes
  Clock::time_point begin_;
  std::atomic<double> expectedSeconds_{0};       // since begin_; 0: unknown
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
