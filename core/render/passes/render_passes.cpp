// SPDX-License-Identifier: BSD-2-Clause
// RenderInPasses: pass sizes, seeds and stopping rules.
#include "core/render/passes/render_passes.h"

#include <algorithm>
#include <array>

#include "core/base/format.h"
#include "core/render/passes/accuracy/error_watch.h"
#include "core/render/passes/pass_parts.h"
#include "core/render/passes/pass_plan.h"
#include "core/render/passes/photons/photon_sets.h"
#include "core/render/passes/progress/pass_progress.h"
#include "core/render/passes/progressive.h"

namespace exphoton {
namespace {

using Clock = std::chrono::steady_clock;

// The first samples of a sequence are well distributed if their number is this number times a power
// of two. A larger number would spoil small passes.
constexpr std::int64_t kWellDistributed = 2;
// Above this share of the room for noise, photons are shot again before the next look.
constexpr double kMuchNoise = .5;

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
        sharesGathers_(job.integrator.SharesGathers(job.scene)),
        progress_(&job.progress, rule,
                  {job.film.PixelCount(), sharesGathers_,
                   rule.accuracy ? rule.accuracy->photonSamples : 0}),
        quietJob_{job.scene,  job.integrator,    job.sampler, job.filter,           job.camera,
                  job.film,   job.threads,       job.log,     progress_.OfPasses(), job.statistics,
                  job.volume, job.integratorName},
        renderer_(quietJob_, options_),
        passFilm_(job.film.Full(), job.film.Crop()),
        sum_(&job.film, {rule.targetError, rule.maxSamples}),
        forecasts_{GroupForecast(job.film.Crop(), sharesGathers_),
                   GroupForecast(job.film.Crop(), sharesGathers_)},
        plan_({rule.targetError, rule.timeLimit, rule.maxSamples, rule.passSamples,
               rule.accuracy && rule.passSamples == 0 ? rule.accuracy->firstSamples : 0,
               rule.accuracy ? rule.accuracy->photonSamples : 0, sharesGathers_}),
        // A certificate needs the light of each sample before and after sharing, pass by pass.
        hasBatches_(rule.passSamples == 0 && !rule.accuracy && !options_.corrections),
        hasRelatedPasses_(rule.passSamples == 0 && (rule.accuracy || hasBatches_)),
        photons_(job.film.Crop(), hasRelatedPasses_ && job.integrator.FillsSignedLight() &&
                                      (rule.accuracy || rule.targetError)),
        continuesSequence_(hasRelatedPasses_ && job.sampler.IsProgressive()),
        error_({job, &parts_, &sum_, &renderer_}, rule.accuracy,
               continuesSequence_ ? GroupSamples::OneSequence : GroupSamples::Independent) {
    // The noise for an accuracy is estimated as if the groups were independent. It is rather too
    // high, because the errors of one sequence partly cancel.
    if (continuesSequence_) sequence_ = job.sampler.WithSamplesPerPixel(WellDistributed());
  }

  PassesResult Run() {
    progress_.Begin();
    step_ = plan_.Next({});
    if (options_.resumed) Resume();
    for (std::optional<StopReason> reason; !reason; reason = Reason(step_)) {
      if (!RunPass(step_)) {
        result_.reason = StopReason::Signal;
        return Finish();
      }
      step_ = plan_.Next(State());
    }
    result_.reason = *reasonMet_;
    if (result_.reason == StopReason::Signal) SaveBetweenPasses();
    return Finish();
  }

 private:
  // Saves or loads the passes that are complete, and the step of the next one.
  void Transfer(ByteArchive* archive) {
    plan_.Transfer(archive);
    char isNewGroup = step_.isNewGroup ? 1 : 0;
    archive->Values(&isNewGroup, &step_.size);
    step_.isNewGroup = isNewGroup != 0;
    archive->Values(&groupSamples_, &preprocessSeconds_, &renderSeconds_);
    photons_.Transfer(archive);
    sum_.TransferCounts(archive);
    const bool isPossible = step_.size >= 1 && step_.size <= rule_.maxSamples &&
                            plan_.Groups() == sum_.Groups() &&
                            (step_.isNewGroup || plan_.Groups() > 0) && groupSamples_ >= 0 &&
                            groupSamples_ <= rule_.maxSamples &&
                            (plan_.Groups() == 0 || sum_.SamplesPerPixel() >= FirstSamples());
    if (!isPossible) throw ArchiveError("its counts of passes contradict each other");
  }

  // No pass of an accuracy is smaller than the first one, except for the last one before a limit.
  std::int64_t WellDistributed() const { return std::max(kWellDistributed, FirstSamples()); }

  // Returns a number of samples that the first group has at least.
  std::int64_t FirstSamples() const {
    return rule_.accuracy ? std::min(rule_.accuracy->firstSamples, rule_.maxSamples) : 1;
  }

  Checkpoint WrapCheckpoint(const Checkpoint& inner) {
    Checkpoint outer;
    outer.hasWork = inner.hasWork || sum_.Passes() > 0;
    outer.save = [this, inner](StateWriter* writer) {
      inner.save(writer);
      writer->AddArchive("passes", [this](ByteArchive* archive) { Transfer(archive); });
      SaveSection("film", job_.film, writer);
      parts_.SaveAovs(writer);
      writer->AddArchive("noise", [this](ByteArchive* archive) { sum_.TransferNoise(archive); });
      writer->AddArchive("forecast", [this](ByteArchive* archive) {
        for (GroupForecast& forecast : forecasts_) forecast.Transfer(archive);
      });
      error_.Save(writer);
    };
    if (!inner.picture) return outer;
    outer.picture = [this, inner] {
      PictureSoFar pass = inner.picture();
      if (sum_.Passes() == 0) return pass;
      PictureSoFar picture{job_.film, std::move(pass.aovs), {}};
      if (picture.aovs) picture.aovs->Clear();
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
    file.Read("noise", [this](ByteArchive* archive) { sum_.TransferNoise(archive); });
    file.Read("forecast", [this](ByteArchive* archive) {
      for (GroupForecast& forecast : forecasts_) forecast.Transfer(archive);
    });
    error_.Load(file);
    job_.log.Notice("continuing \"" + file.Path() + "\" after " + std::to_string(sum_.Passes()) +
                    (sum_.Passes() == 1 ? " pass" : " passes"));
    if (sum_.Passes() > 0) parts_.Show(job_.film);
  }

  PassPlan::State State() const {
    PassPlan::State state;
    state.samples = sum_.SamplesPerPixel();
    if (rule_.targetError) {
      // More samples do not reduce the noise of photons that all groups share.
      const double shared = photons_.SharedNoise(), room = *rule_.targetError - shared;
      if (const auto noise = sum_.Noise())
        state.noise = (*noise - shared) * *rule_.targetError / room;
      state.enough = forecasts_[0].SamplesFor(room);
    }
    if (error_.Rule()) state.needed = error_.NeededSamples();
    state.elapsed = rule_.timeLimit ? SecondsSince(rule_.start) : 0;
    state.sample = renderSeconds_ / double(std::max<std::int64_t>(sum_.SamplesPerPixel(), 1));
    state.keepsPhotons = photons_.IsKnown();
    // The first photons may be a pilot's, which cost no time here.
    const double dear = rule_.accuracy ? rule_.accuracy->photonSamples * state.sample : 0;
    state.preprocess = state.keepsPhotons ? 0 : std::max(preprocessSeconds_, dear);
    return state;
  }

  bool RunPass(const PassPlan::Step& step) {
    if (step.isNewGroup) groupSamples_ = 0;
    const std::uint64_t group = std::uint64_t(plan_.Groups() - (step.isNewGroup ? 0 : 1));
    RenderPass pass;
    pass.sampleCount = step.size;
    std::unique_ptr<Sampler> pattern;
    if (sequence_) {
      pass.sampleSeed = HashKey({options_.seed, kGroupSeed});
      pass.firstSample = sum_.SamplesPerPixel();
    } else {
      // The pass uses a complete sample pattern with a separate seed.
      pass = PatternPass(options_.seed, group, groupSamples_, step.size);
      pattern = job_.sampler.WithSamplesPerPixel(step.size);
    }
    pass.preprocessSeed =
        HashKey({options_.seed, kPassSeed, std::uint64_t(photons_.SetOf(int(group)))});
    if (rule_.progressiveAlpha) {
      pass.diskArea = DiskAreaOfPass(int(group), *rule_.progressiveAlpha);
      pass.time = TimeOfPass(int(group), options_.seed);
    }
    if (hasBatches_)
      pass.sharing =
          step.isNewGroup ? RenderPass::Sharing::BeginsBatch : RenderPass::Sharing::ContinuesBatch;
    pass.photonNoise = photons_.Measurement();
    pass.gathers = error_.BeginPass(step.size);
    passFilm_.Clear();
    progress_.BeginPass(plan_, step, State(), renderSeconds_);
    const bool isWhole = renderer_.Run(pass, sequence_ ? *sequence_ : *pattern, &passFilm_);
    // In a picture of whole passes all pixels have the same samples. The tiles of a part of a pass
    // may also lack the shared light that their gathers bring later.
    const bool isShown = isWhole || sum_.Passes() == 0;
    if (isWhole)
      TakePass(step, int(group));
    else if (isShown)
      job_.film.Add(passFilm_);
    parts_.TakeAovs(isShown);
    parts_.Show(job_.film);
    return isWhole;
  }

  void TakePass(const PassPlan::Step& step, int group) {
    if (rule_.progressiveAlpha)
      result_.lastDiskArea = DiskAreaOfPass(group, *rule_.progressiveAlpha);
    plan_.Take(step);
    if (step.isNewGroup && photons_.Divides(group)) {
      sum_.JoinGroups();
      error_.JoinGroups();
    }
    sum_.Add(passFilm_, step.size, group);
    error_.Add(passFilm_, step.size, group);
    if (group < 2 && rule_.passSamples == 0 && !rule_.accuracy) TakeForecast(step.size, group);
    photons_.EndPass(step.size);
    TakePhotonNoise(group);
    // Each look costs confidence. Where photons of the next group will remove much of the noise,
    // the picture is not yet good enough.
    const AccuracyRule* const accuracy = error_.Rule();
    const bool isFarAway = accuracy && photons_.Divides(group + 1) &&
                           photons_.FirstNoise() > kMuchNoise * accuracy->RoomForNoise();
    const Clock::time_point start = Clock::now();
    if (accuracy && !isFarAway) LookAtError(group);
    renderSeconds_ += SecondsSince(start);  // shares gathers before it looks
    if (group == 2)
      for (GroupForecast& forecast : forecasts_) forecast.Release();
    if (step.isNewGroup)
      preprocessSeconds_ = std::max(preprocessSeconds_, renderer_.PreprocessSeconds());
    renderSeconds_ += renderer_.RenderSeconds();
    groupSamples_ += step.size;
    progress_.ShowPasses(sum_, accuracy);
  }

  void TakePhotonNoise(int group) {
    const std::vector<double> levels = photons_.IsKnown()
                                           ? (group > 0 ? sum_.Levels() : forecasts_[0].Levels())
                                           : std::vector<double>();
    if (levels.empty()) return;
    photons_.Measure(levels);
    photons_.Decide(error_.Rule() ? error_.Rule()->RoomForNoise() : *rule_.targetError, group + 1);
    sum_.SetPhotonNoise(photons_.FirstNoise());
    error_.SetPhotonNoise(photons_.FirstNoise());
    job_.log.Verbose(Format("the photons cause a noise of %.3g of relMSE", photons_.FirstNoise()));
  }

  // The bias that a look finds leaves less room for the noise of the photons.
  void LookAtError(int group) {
    const bool isShared = photons_.IsKnown() || photons_.Divides(group + 1);
    error_.Look({photons_.SharedNoise(), isShared ? photons_.FirstNoise() : 0});
    if (photons_.IsKnown()) photons_.Decide(error_.Rule()->RoomForNoise(), group + 1);
  }

  void TakeForecast(std::int64_t samples, int group) {
    forecasts_[std::size_t(group)].Add(passFilm_, samples);
    const double a = forecasts_[0].Difference(), b = forecasts_[1].Difference();
    if (sequence_ && a > 0 && b > 0)
      sum_.CorrectForSequence((a + b) / 2, TrustIn(plan_.FirstSamples(), sharesGathers_));
  }

  // Returns whether the target is reached by little, and only a part of the second group shows it.
  bool IsDoubtful(const PassPlan::Step& next) const {
    constexpr double kClearly = 1.25;
    const bool isPart = plan_.Groups() == 2 && !next.isNewGroup && next.size > 0;
    return isPart && kClearly * *sum_.Noise() > *rule_.targetError;
  }

  // `next` is the step that would follow.
  std::optional<StopReason> Reason(const PassPlan::Step& next) {
    reasonMet_ = sum_.Reason();
    if (reasonMet_ == StopReason::TargetError && IsDoubtful(next)) reasonMet_.reset();
    const AccuracyRule* const accuracy = error_.Rule();
    if (accuracy && accuracy->IsReached())
      reasonMet_ = StopReason::Accuracy;
    else if (accuracy && error_.IsBiasTooLarge())
      reasonMet_ = StopReason::Bias;
    else if (accuracy && error_.IsTooDear())
      reasonMet_ = StopReason::Price;
    if (reasonMet_) return reasonMet_;
    if (rule_.timeLimit && next.size < 1)
      reasonMet_ = StopReason::TimeLimit;
    else if (options_.stop && *options_.stop)
      reasonMet_ = StopReason::Signal;
    return reasonMet_;
  }

  PassesResult Finish() {
    error_.Complete();
    progress_.End(result_.reason != StopReason::Signal);
    result_.render = renderer_.Finish();
    error_.Describe(&result_);
    sum_.Describe(parts_.NeedsVariances(), &result_);
    if (result_.reason == StopReason::Signal) result_.render.isComplete = false;
    return std::move(result_);
  }

  const RenderJob& job_;
  const StoppingRule& rule_;
  PassParts parts_;
  const RenderOptions& options_;  // of one pass
  const bool sharesGathers_;
  PassProgress progress_;
  RenderJob quietJob_;
  PassRenderer renderer_;
  Film passFilm_;
  PassSum sum_;
  std::array<GroupForecast, 2> forecasts_;  // of the first groups
  PassPlan plan_;
  const bool hasBatches_;        // whether the passes of a group share their gathers together
  const bool hasRelatedPasses_;  // whether passes may continue a sequence or share photons
  PhotonSets photons_;
  const bool continuesSequence_;  // whether all passes continue one sequence of samples
  ErrorWatch error_;
  PassPlan::Step step_;  // the pass that is being rendered, or the next one
  std::int64_t groupSamples_ = 0;
  double preprocessSeconds_ = 0, renderSeconds_ = 0;  // of one group, and of all passes
  // The camera samples that all passes continue. Null: each pass has a pattern of its own.
  std::unique_ptr<Sampler> sequence_;
  PassesResult result_;
  std::optional<StopReason> reasonMet_;
};

}  // namespace

PassesResult RenderInPasses(const RenderJob& job, const RenderOptions& options,
                            const StoppingRule& rule) {
  return Passes(job, options, rule).Run();
}

}  // namespace exphoton
