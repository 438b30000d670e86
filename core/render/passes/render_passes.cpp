// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses: pass sizes, seeds and stopping rules.
#include "core/render/passes/render_passes.h"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/render/certificate/corrections.h"
#include "core/render/passes/pass_parts.h"
#include "core/render/passes/pass_plan.h"

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kProgressSteps = 1000;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Passes {
 public:
  Passes(const RenderJob& job, const RenderOptions& options, const StoppingRule& rule)
      : job_(job),
        rule_(rule),
        parts_(job, options, [this](const Checkpoint& inner) { return WrapCheckpoint(inner); }),
        options_(parts_.Options()),
        quiet_(ProgressReporter::Mode::Quiet),
        quietJob_{job.scene,  job.integrator, job.sampler, job.filter,
                  job.camera, job.film,       job.threads, job.log,
                  quiet_,     job.statistics, job.volume,  job.integratorName},
        renderer_(quietJob_, options_),
        passFilm_(job.film.Full(), job.film.Crop()),
        noise_(job.film.Crop(), kGroups),
        forecast_(job.film.Crop()),
        plan_({rule.targetError, rule.timeLimit, rule.maxSamples, rule.passSamples}) {
    if (job.sampler.IsProgressive())
      progressiveSampler_ = job.sampler.WithSamplesPerPixel(rule.maxSamples);
    quiet_.SetListener([this] { ShowProgress(); });
  }

  PassesResult Run() {
    begin_ = Clock::now();
    job_.progress.Begin("Rendering", kProgressSteps);
    step_ = plan_.Next({});
    if (options_.resumed) Resume();
    for (std::optional<StopReason> reason; !reason; reason = Reason(step_)) {
      if (!RunPass(step_)) {
        result_.reason = StopReason::Signal;
        return Finish();
      }
      const PassPlan::State state = State();
      step_ = plan_.Next(state);
      if (const auto left = plan_.SecondsLeft(state))
        expectedSeconds_ = SecondsSince(begin_) + *left;
    }
    result_.reason = *reasonMet_;
    if (result_.reason == StopReason::Signal) SaveBetweenPasses();
    return Finish();
  }

 private:
  // Saves or loads the passes that are complete, and the step of the next one.
  void Transfer(ByteArchive* archive) {
    plan_.Transfer(archive);
    char isNewGroup = step_.isNewGroup ? 1 : 0, isPattern = step_.isPattern ? 1 : 0;
    archive->Values(&isNewGroup, &step_.size, &isPattern);
    step_.isNewGroup = isNewGroup != 0;
    step_.isPattern = isPattern != 0;
    archive->Values(&groupSamples_, &preprocessSeconds_, &renderSeconds_, &result_.passes,
                    &result_.samplesPerPixel);
    double noise = result_.noise.value_or(std::numeric_limits<double>::quiet_NaN());
    archive->Values(&noise);
    result_.noise = noise == noise ? std::optional(noise) : std::nullopt;
    const bool isPossible = step_.size >= 1 && step_.size <= rule_.maxSamples &&
                            result_.passes >= 0 && plan_.Groups() >= 0 &&
                            plan_.Groups() <= result_.passes && result_.samplesPerPixel >= 0 &&
                            result_.samplesPerPixel <= rule_.maxSamples && groupSamples_ >= 0 &&
                            groupSamples_ <= rule_.maxSamples;
    if (!isPossible) throw ArchiveError("its counts of passes contradict each other");
  }

  Checkpoint WrapCheckpoint(const Checkpoint& inner) {
    Checkpoint outer;
    outer.hasWork = inner.hasWork || result_.passes > 0;
    outer.save = [this, inner](StateWriter* writer) {
      inner.save(writer);
      ByteArchive passes;
      Transfer(&passes);
      writer->Add("passes", passes.Take());
      SaveSection("film", job_.film, writer);
      parts_.SaveAovs(writer);
      SaveSection("noise", noise_, writer);
      SaveSection("forecast", forecast_, writer);
    };
    if (!inner.picture) return outer;
    outer.picture = [this, inner] {
      PictureSoFar pass = inner.picture();
      PictureSoFar picture{job_.film, std::move(pass.aovs), {}};
      picture.film.Add(pass.film);
      parts_.AddAovs(&picture);
      return picture;
    };
    return outer;
  }

  void SaveBetweenPasses() {
    Checkpoint between;
    between.save = [this](StateWriter* writer) { renderer_.SaveTotals(writer); };
    parts_.TakeLast(between);
  }

  void Resume() {
    const StateFile& file = *options_.resumed;
    file.Read("passes", [this](ByteArchive* archive) { Transfer(archive); });
    LoadSection("film", &job_.film, file);
    parts_.LoadAovs(file);
    LoadSection("noise", &noise_, file);
    LoadSection("forecast", &forecast_, file);
    job_.log.Notice("continuing \"" + file.Path() + "\" after " + std::to_string(result_.passes) +
                    (result_.passes == 1 ? " pass" : " passes"));
  }

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
      pass = PatternPass(options_.seed, group, groupSamples_, step.size);
      pattern = job_.sampler.WithSamplesPerPixel(step.size);
    }
    passFilm_.Clear();
    const bool isWhole = renderer_.Run(pass, goesOn ? *progressiveSampler_ : *pattern, &passFilm_);
    job_.film.Add(passFilm_);
    parts_.TakeAovs();
    parts_.Show(job_.film);
    if (isWhole) TakePass(step, int(group % kGroups));
    return isWhole;
  }

  void TakePass(const PassPlan::Step& step, int group) {
    plan_.Take(step);
    noise_.Add(group, passFilm_, step.size);
    if (options_.corrections) options_.corrections->EndPass(group, step.size);
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
      if (parts_.NeedsVariances()) result_.variances = noise_.Variances();
    }
    if (result_.reason == StopReason::Signal) result_.render.isComplete = false;
    return std::move(result_);
  }

  const RenderJob& job_;
  const StoppingRule& rule_;
  PassParts parts_;
  const RenderOptions& options_;  // of one pass
  ProgressReporter quiet_;        // hides the phases of each pass, which would be many lines
  RenderJob quietJob_;
  PassRenderer renderer_;
  Film passFilm_;
  PassNoise noise_;  // by group
  GroupForecast forecast_;
  PassPlan plan_;
  PassPlan::Step step_;  // the pass that is being rendered, or the next one
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

}  // namespace exphoton
