// SPDX-License-Identifier: BSD-2-Clause
// The settings form a chain: each one moves one more cause of bias towards its limit, and the last
// one is corrected by samples of the exact radiance. The differences of successive settings are
// the biases, so they add up to the difference between the picture and the end of the chain.
#include "core/app/budget/budget_renders.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/app/budget/budget_settings.h"
#include "core/app/budget/setting_renders.h"
#include "core/base/error.h"
#include "core/render/sharing/sharing_plan.h"

namespace exphoton::cli {
namespace {

// The chain has more samples, because pictures that share no gathers have more noise.
constexpr std::int64_t kChainFactor = 4;
constexpr double kCorrectionsPerPixel = 32;  // of one picture
constexpr double kCausticPhotons = 320000, kLeastCausticFactor = 4, kMostCausticFactor = 16;

// The purposes of seeds.
constexpr std::uint64_t kBudgetSeed = 0x627564676574ull;
enum class Purpose : std::uint64_t { Photons, First, Second, Chain, Measured, Reference };

class BudgetMeasurement {
 public:
  BudgetMeasurement(const RenderCommand& command, const BudgetOptions& options,
                    FileSource::Streams* streams)
      : command_(command),
        options_(options),
        scene_(command.scenes.front(), "exphoton budget", streams),
        load_(LoadOptionsOf(command)) {}

  MeasuredBudget Run() {
    RenderScene();
    RenderMoreRays();
    RenderChain();
    RenderCorrections();
    TakeBiases();
    Judge();
    return std::move(result_);
  }

 private:
  struct Link {
    ErrorCause cause;
    LoadOptions load;
  };

  LoadOptions LoadOptionsOf(const RenderCommand& command) {
    scene_.ShowMessages(options_.log);
    return scene_.Options(command);
  }

  std::uint64_t Seed(Purpose purpose, std::size_t number) const {
    return HashKey({command_.seed, kBudgetSeed, std::uint64_t(purpose), number});
  }
  std::vector<PictureSeeds> Seeds(Purpose photons, std::span<const Purpose> samples) const {
    std::vector<PictureSeeds> seeds;
    for (std::size_t r = 0; r < std::size_t(options_.seeds); ++r)
      for (const Purpose purpose : samples) seeds.push_back({Seed(photons, r), Seed(purpose, r)});
    return seeds;
  }
  void Say(const char* text) const {
    if (options_.showsProgress) std::fprintf(stderr, "exphoton: renders %s\n", text);
  }
  SettingRequest Request(std::int64_t samples, std::vector<PictureSeeds> pictures) const {
    SettingRequest request;
    request.samples = samples;
    request.footprintSamples = footprint_;
    request.pictures = std::move(pictures);
    return request;
  }

  // Two pictures for each set of photons.
  void RenderScene() {
    Say("of the scene");
    setup_ = scene_.Load(load_);
    if (!setup_->integrator->Certification(*setup_->scene))
      throw Error(ExitStatus::CommandLine, "integrator \"" + setup_->integratorName +
                                               "\" has no error budget; photonmap and "
                                               "exphotonmap have one, without \"show\"");
    result_.integrator = setup_->integratorName;
    result_.width = setup_->crop.Width(), result_.height = setup_->crop.Height();
    result_.samples = setup_->sampler->SamplesPerPixel();
    footprint_ = command_.footprintSamples > 0 ? command_.footprintSamples : result_.samples;
    constexpr Purpose kTwo[] = {Purpose::First, Purpose::Second};
    base_ = RenderSetting(*setup_, Request(result_.samples, Seeds(Purpose::Photons, kTwo)),
                          command_.threadCount);
    seeds_.resize(std::size_t(options_.seeds));
    for (std::size_t r = 0; r < seeds_.size(); ++r)
      seeds_[r].pictures = {base_.pictures[2 * r], base_.pictures[2 * r + 1]};
    sharesGathers_ = PlanSharing(*setup_->integrator, *setup_->scene, *setup_->camera).isOn;
    result_.costs.maps = base_.mapSeconds, result_.costs.camera = base_.sampleSeconds;
  }

  double RaysPerSample() const { return base_.GatherRaysPerSample(); }

  void RenderMoreRays() {
    BudgetCosts& costs = result_.costs;
    const double samples = double(result_.samples);
    costs.lowerBound = costs.maps + costs.camera / samples;
    if (!(RaysPerSample() > 0)) return;
    Say("with more gather rays");
    constexpr Purpose kTwo[] = {Purpose::First, Purpose::Second};
    const SettingRenders renders = RenderSetting(
        *scene_.Load(WithMoreRays(load_, *setup_)),
        Request(result_.samples, Seeds(Purpose::Photons, kTwo)), command_.threadCount);
    for (std::size_t r = 0; r < seeds_.size(); ++r)
      seeds_[r].withMoreRays = {renders.pictures[2 * r], renders.pictures[2 * r + 1]};
    frame_.rayFactor = kRayFactor;
    const double added = (renders.sampleSeconds - base_.sampleSeconds) / (kRayFactor - 1);
    costs.rays = std::clamp(added, 0., base_.sampleSeconds);
    costs.camera = base_.sampleSeconds - costs.rays;
    costs.lowerBound = costs.maps + (costs.camera + costs.rays / RaysPerSample()) / samples;
  }

  // Returns the settings of the chain after the first one.
  std::vector<Link> Links(const LoadOptions& first) {
    std::vector<Link> links;
    LoadOptions last = first;
    const auto add = [&](ErrorCause cause, bool isPresent, const auto& change) {
      if (!isPresent) return;
      last = change(std::move(last));
      links.push_back({cause, last});
    };
    causticFactor_ = std::clamp(kCausticPhotons / std::max(base_.causticPhotons, 1.),
                                kLeastCausticFactor, kMostCausticFactor);
    add(ErrorCause::CausticKernel, base_.causticPhotons > 0, [&](LoadOptions load) {
      return WithCausticPhotons(std::move(load), base_.causticPhotons * causticFactor_);
    });
    const bool isCut =
        double(base_.rays.cutThroughput) > 0 || double(base_.rays.cutGatherThroughput) > 0;
    add(ErrorCause::DepthLimits, isCut,
        [&](LoadOptions load) { return WithDeepPaths(std::move(load), *setup_); });
    const bool isForced = load_.effects != "auto" && load_.effects != "all";
    add(ErrorCause::SkippedEffects, isForced,
        [&](LoadOptions load) { return WithAllEffects(std::move(load)); });
    return links;
  }

  SettingRenders RenderLink(const LoadOptions& load) {
    constexpr Purpose kOne[] = {Purpose::Chain};
    return RenderSetting(*scene_.Load(load),
                         Request(kChainFactor * result_.samples, Seeds(Purpose::Photons, kOne)),
                         command_.threadCount);
  }

  void RenderChain() {
    Say(sharesGathers_ ? "without sharing" : "with more samples");
    last_ = sharesGathers_ ? WithoutSharing(load_) : load_;
    const std::vector<Link> links = Links(last_);
    SettingRenders before = RenderLink(last_);
    chainBegin_ = before.pictures;
    for (const Link& link : links) {
      Say(("with " + std::string(ErrorCauseName(link.cause)) + " moved").c_str());
      SettingRenders after = RenderLink(link.load);
      AddBias(link.cause, before.pictures, after.pictures);
      TakeCost(link.cause, before, after);
      before = std::move(after);
      last_ = link.load;
    }
  }

  void TakeCost(ErrorCause cause, const SettingRenders& before, const SettingRenders& after) {
    const double maps = after.mapSeconds - before.mapSeconds;
    const double added =
        std::max(maps + (after.sampleSeconds - before.sampleSeconds) / kChainFactor, 0.);
    if (cause == ErrorCause::CausticKernel)
      result_.costs.causticMap = std::max(maps, 0.) / (causticFactor_ - 1);
    if (cause == ErrorCause::DepthLimits) result_.costs.depth = added;
    if (cause == ErrorCause::SkippedEffects) result_.costs.effects = added;
  }

  // The bias of a cause is the first picture minus the second one.
  void AddBias(ErrorCause cause, const std::vector<PictureValues>& with,
               const std::vector<PictureValues>& without) {
    frame_.biasCauses.push_back(cause);
    for (std::size_t r = 0; r < seeds_.size(); ++r) {
      PictureValues bias = with[r];
      for (std::size_t i = 0; i < bias.size(); ++i) bias[i] -= without[r][i];
      seeds_[r].biases.push_back(std::move(bias));
    }
  }

  // The expected correction is the true radiance minus the picture's.
  void RenderCorrections() {
    Say("with exact radiance");
    constexpr Purpose kOne[] = {Purpose::Chain};
    SettingRequest request = Request(result_.samples, Seeds(Purpose::Photons, kOne));
    request.correctedShare = CorrectedShare();
    const SettingRenders renders =
        RenderSetting(*scene_.Load(last_), request, command_.threadCount);
    const std::vector<PictureValues> nothing(seeds_.size(), PictureValues(PictureSize()));
    AddBias(ErrorCause::Blur, nothing, renders.corrections);
  }

  double CorrectedShare() const {
    const double reads = double(result_.samples) * std::max(RaysPerSample(), 1.);
    return std::min(kCorrectionsPerPixel / reads, 1.);
  }
  std::size_t PictureSize() const { return seeds_.front().pictures[0].size(); }

  void TakeBiases() {
    frame_.width = result_.width;
    if (!sharesGathers_) return;
    std::vector<PictureValues> shared;
    for (const SeedErrors& seed : seeds_) {
      PictureValues mean = seed.pictures[0];
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (mean[i] + seed.pictures[1][i]) / 2;
      shared.push_back(std::move(mean));
    }
    AddBias(ErrorCause::Sharing, shared, chainBegin_);
  }

  // Renders pictures with seeds of their own and compares them with the budget.
  void Judge() {
    constexpr Purpose kOne[] = {Purpose::Measured};
    SettingRequest request = Request(result_.samples, Seeds(Purpose::Measured, kOne));
    result_.isByReference = options_.referenceSamples > 0;
    Say(result_.isByReference ? "to compare with the reference" : "with a certificate");
    if (!result_.isByReference) request.correctedShare = CorrectedShare();
    const SettingRenders renders = RenderSetting(*setup_, request, command_.threadCount);
    if (result_.isByReference)
      JudgeByReference(renders);
    else
      JudgeByCertificate(renders);
    TakeSharingCost();
  }

  void SetLevels(std::span<const PictureValues> pictures) {
    PictureValues mean(PictureSize());
    for (const PictureValues& picture : pictures)
      for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += picture[i] / double(pictures.size());
    frame_.levels.clear();
    for (const double value : mean) frame_.levels.push_back(value * value);
  }

  void JudgeByReference(const SettingRenders& renders) {
    Say("of the reference");
    const std::int64_t half = std::max<std::int64_t>(options_.referenceSamples / 2, 1);
    const SettingRenders halves =
        RenderSetting(*scene_.Load(OfReference(load_)),
                      Request(half, {{Seed(Purpose::Reference, 0), Seed(Purpose::Reference, 1)},
                                     {Seed(Purpose::Reference, 2), Seed(Purpose::Reference, 3)}}),
                      command_.threadCount);
    if (halves.pictures[0].size() != PictureSize())
      throw Error(ExitStatus::Internal, "the reference has another size");
    SetLevels(halves.pictures);
    result_.budget = MakeBudget(seeds_, frame_, options_.blockWidth);
    result_.measured = MeasureError(renders.pictures, {halves.pictures[0], halves.pictures[1]},
                                    frame_, result_.budget.blockWidth);
  }

  // The certificate chooses the blocks.
  void JudgeByCertificate(const SettingRenders& renders) {
    SetLevels(base_.pictures);
    const std::vector<PictureValues>& pictures = renders.pictures;
    MeasuredError& measured = result_.measured;
    measured.noise = NoiseBetween(pictures, frame_);
    const auto certificate = Certify(*renders.groups, frame_.levels, measured.noise.value,
                                     CertificateGoal::ForNoise(measured.noise.value));
    const BlockBias& bias = certificate->bias;
    measured.bias = {bias.squared, (bias.upper - bias.lower) / (2 * kQuantile95)};
    measured.sum = {measured.noise.value + measured.bias.value,
                    std::hypot(measured.noise.error, measured.bias.error)};
    const int width = options_.blockWidth > 0 ? options_.blockWidth : bias.blockWidth;
    result_.budget = MakeBudget(seeds_, frame_, width);
  }

  // Without sharing, more samples give the same noise.
  void TakeSharingCost() {
    if (!sharesGathers_) return;
    const BudgetCosts& costs = result_.costs;
    double photons = 0;
    for (const ErrorPart& part : result_.budget.parts)
      if (part.cause == ErrorCause::PhotonNoise) photons = part.share.value;
    const double within = result_.budget.noise.value - photons;
    const double unshared = (NoiseBetween(chainBegin_, frame_).value - photons) * kChainFactor;
    if (within > 0)
      result_.costs.sharing = std::max(unshared / within - 1, 0.) * (costs.camera + costs.rays);
  }

  const RenderCommand& command_;
  const BudgetOptions& options_;
  SmallScene scene_;
  LoadOptions load_;
  LoadOptions last_;  // of the chain
  std::unique_ptr<RenderSetup> setup_;
  std::int64_t footprint_ = 0;
  bool sharesGathers_ = false;
  double causticFactor_ = 1;
  SettingRenders base_;
  std::vector<PictureValues> chainBegin_;  // one picture for each seed
  std::vector<SeedErrors> seeds_;
  BudgetFrame frame_;
  MeasuredBudget result_;
};

}  // namespace

MeasuredBudget MeasureBudget(const RenderCommand& command, const BudgetOptions& options,
                             FileSource::Streams* streams) {
  return BudgetMeasurement(command, options, streams).Run();
}

}  // namespace exphoton::cli
