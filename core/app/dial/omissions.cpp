// SPDX-License-Identifier: BSD-2-Clause
// All pairs have a tenth of the photons of the picture, and density estimates use a tenth of them.
// Disks keep their size then, so that estimates have the same mean and more noise.
#include "core/app/dial/omissions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/app/dial/omission_bound.h"
#include "core/app/dial/pilots/counted_cost.h"
#include "core/app/dial/pilots/pilot.h"
#include "core/base/format.h"
#include "core/scene/required_features.h"

namespace exphoton::cli {
namespace {

// Effects that add light and leave lights and media in the scene. The dearest ones come first.
constexpr Feature kCandidates[] = {Feature::Caustics, Feature::Glossy, Feature::Indirect,
                                   Feature::Specular};

constexpr double kBudget = .1;  // of the accuracy, for the bounds of all omissions
// For the first pairs: of what caustics cost, and of the price. Only the former is known before.
constexpr double kCausticPairShare = .4, kPairShare = .05;
constexpr double kDearer = 1.2;      // a small render may cost this much more than expected
constexpr double kSavedShare = .5;   // of what an omission saves, for its other pairs
constexpr double kWorthwhile = .95;  // of the time, at most, with an omission

// What the picture costs relative to its price, if it lacks an effect.
struct Saving {
  double maps = 0, samples = 0;  // shares of the costs of photons and of samples
};

class OmissionFinder {
 public:
  OmissionFinder(const RenderCommand& command, PilotRenderer* pilots, Candidate* chosen, Log* log)
      : command_(command), pilots_(*pilots), chosen_(*chosen), log_(*log) {}

  std::vector<OmittedEffect> Find() {
    if (!MayBeOmitted()) return {};
    const PilotRenderer::Loan loan(&pilots_, chosen_.integrator, chosen_.settings);
    setup_ = &loan.Setup();
    candidates_ = Candidates();
    if (candidates_.empty()) return {};
    with_.push_back(RenderPair(0));
    spent_ = SumOf(with_.front().cost);
    for (const Feature feature : candidates_) Try(feature);
    return omitted_;
  }

 private:
  bool MayBeOmitted() const {
    return !command_.keepsSettings && command_.load.effects != "all" &&
           IsAffordable(ShareForPairs());
  }
  // The share of the price that the first pairs may take.
  double ShareForPairs() const { return std::max(ShareForCaustics(), kPairShare); }
  double ShareForCaustics() const { return kCausticPairShare * CausticShare(); }
  double CausticShare() const { return std::min(chosen_.causticShare, 1.); }
  bool IsAffordable(double share) const {
    return kDearer * 2 * FirstCost() < share * chosen_.price.seconds;
  }
  double Affordable() const { return ShareForPairs() * chosen_.price.seconds; }
  // Returns the expected cost of one render with all effects.
  double FirstCost() const {
    const double samples = kFewPhotons * chosen_.photonSamples + pilots_.OnceShare();
    return samples * chosen_.priceOfSample;
  }

  std::vector<Feature> Candidates() const {
    std::vector<Feature> candidates;
    const std::string named = "," + command_.load.effects;
    const auto isIn = [&](const std::string& text) { return named.find(text) != named.npos; };
    for (const Feature feature : kCandidates) {
      // Caustics need specular surfaces.
      const bool isNamed = isIn("," + std::string(FeatureName(feature)) + "=") ||
                           (feature == Feature::Specular && isIn(",caustics=on"));
      if (setup_->scene->Features().Needs(feature) && !isNamed && MayPay(feature) &&
          IsAffordable(feature == Feature::Caustics ? ShareForCaustics() : kPairShare))
        candidates.push_back(feature);
    }
    return candidates;
  }

  // Returns the share of the light of a pilot. `glossy` has no part of its own, and `caustics` are
  // the part `caustic`.
  std::optional<double> LightOf(Feature feature) const {
    const std::string name = feature == Feature::Caustics ? "caustic" : FeatureName(feature);
    for (const MeasuredLight& part : chosen_.parts)
      if (part.name == name) return part.share;
    return std::nullopt;
  }

  // The bound of an effect would exceed its light.
  bool MayPay(Feature feature) const {
    const std::optional<double> light = LightOf(feature);
    if (!light) return true;
    const bool isCaustics = feature == Feature::Caustics;
    const double time = isCaustics ? CausticShare() : 1;
    if (IsCovered(*light) && (1 - time) * GrowthFor(*light) < kWorthwhile) return true;
    log_.Verbose(std::string(FeatureName(feature)) + " stays on: " + Plain(100 * *light, 2) +
                 " % of the light of a pilot" +
                 (isCaustics ? ", would take " + Plain(100 * time, 2) + " % of the time" : ""));
    return false;
  }

  PilotRenderer::OnePass RenderPair(std::uint64_t pair) {
    return pilots_.RenderOnce(*setup_, pair);
  }

  static double SumOf(const CountedCost& cost) { return cost.maps + cost.samples; }
  // Returns whether the other pairs are worth their cost, after the first one.
  bool IsWorthPairs(const CountedCost& without, double time) const {
    const double pairs = OmissionSample::kPairs - 1;
    const double left = pairs * SumOf(without) +
                        std::max(pairs + 1 - double(with_.size()), 0.) * SumOf(with_.front().cost);
    return left < std::max(Affordable() - spent_, kSavedShare * time * chosen_.price.seconds);
  }

  // Renders pair i without the effect, and with it where that is missing.
  void AddPair(Feature feature, std::size_t i, OmissionSample* sample, CountedCost* without) {
    if (with_.size() <= i) {
      with_.push_back(RenderPair(i));
      spent_ += SumOf(with_.back().cost);
    }
    const RequiredFeatures plan = setup_->scene->Features();
    Omit({{FeatureName(feature)}}, *setup_);
    const PilotRenderer::OnePass other = RenderPair(i);
    setup_->scene->SetFeatures(plan, setup_->camera->Shutter());
    spent_ += SumOf(other.cost);
    sample->Add(with_[i].values, other.values);
    without->maps += other.cost.maps;
    without->samples += other.cost.samples;
    lastWithout_.push_back(other);
  }

  Saving SavingOf(const CountedCost& without, std::size_t pairs) const {
    CountedCost with;
    for (std::size_t i = 0; i < pairs; ++i) {
      with.maps += with_[i].cost.maps;
      with.samples += with_[i].cost.samples;
    }
    const auto share = [](double less, double more) { return more > 0 ? 1 - less / more : 0; };
    return {share(without.maps, with.maps), share(without.samples, with.samples)};
  }

  // Returns the share of the time that an omission saves.
  double TimeOf(const Saving& saving) const {
    const double maps = std::min(chosen_.photonShare, 1.);
    return maps * saving.maps + (1 - maps) * saving.samples;
  }

  // Noise falls at least as fast as the inverse of the samples.
  double GrowthFor(double bound) const {
    const double left = 1 - (BoundOf(omitted_) + bound) / *command_.accuracy;
    return left > 0 ? 1 / (left * left) : std::numeric_limits<double>::infinity();
  }
  bool IsCovered(double bound) const {
    return BoundOf(omitted_) + bound <= kBudget * *command_.accuracy;
  }

  void Try(Feature feature) {
    OmissionSample sample(setup_->crop.Width(), setup_->crop.Height());
    CountedCost without;
    lastWithout_.clear();
    if (SumOf(with_.front().cost) + spent_ > Affordable()) return;
    AddPair(feature, 0, &sample, &without);
    const double share = std::abs(sample.MeanShare());
    const double likely = TimeOf(SavingOf(without, 1));
    if (!(share > 0) || !IsCovered(share) || !(1 - likely < kWorthwhile) ||
        !IsWorthPairs(without, likely))
      return Explain(feature, share, likely);
    for (std::size_t i = 1; i < std::size_t(OmissionSample::kPairs); ++i)
      AddPair(feature, i, &sample, &without);
    const Saving saving = SavingOf(without, OmissionSample::kPairs);
    const std::optional<OmissionBound> bound = sample.Bound(int(candidates_.size()));
    const double time = TimeOf(saving);
    if (!bound || !IsCovered(bound->Upper()) ||
        !((1 - time) * GrowthFor(bound->Upper()) < kWorthwhile))
      return Explain(feature, bound ? bound->Upper() : share, time);
    Take({FeatureName(feature), bound->Upper(), time}, saving);
  }

  // Later effects are compared with the picture without this one.
  void Take(const OmittedEffect& effect, const Saving& saving) {
    Candidate& chosen = chosen_;
    const double left = 1 - BoundOf(omitted_) / *command_.accuracy;
    const double growth = GrowthFor(effect.bound) * left * left;
    omitted_.push_back(effect);
    chosen.price.seconds *= (1 - effect.time) * growth;
    chosen.price.samples *= growth;
    chosen.photonShare *= (1 - saving.maps) / (1 - effect.time);
    chosen.photonSamples *= (1 - saving.maps) / (1 - saving.samples);
    Omit({effect}, *setup_);
    with_ = std::move(lastWithout_);
  }

  void Explain(Feature feature, double share, double time) {
    log_.Verbose(std::string(FeatureName(feature)) + " stays on: " + Plain(100 * share, 2) +
                 " % of the light, takes " + Plain(100 * time, 2) + " % of the time");
  }

  const RenderCommand& command_;
  PilotRenderer& pilots_;
  Candidate& chosen_;
  Log& log_;
  const RenderSetup* setup_ = nullptr;
  std::vector<Feature> candidates_;
  std::vector<PilotRenderer::OnePass> with_, lastWithout_;
  double spent_ = 0;
  std::vector<OmittedEffect> omitted_;
};

}  // namespace

std::string TextOf(const OmittedEffect& effect) {
  return effect.name + " off: at most " + Plain(100 * effect.bound, 2) +
         " % of the light, would take " + Plain(100 * effect.time, 2) + " % of the time";
}

bool HaveSameNames(const std::vector<OmittedEffect>& a, const std::vector<OmittedEffect>& b) {
  return std::ranges::equal(a, b, {}, &OmittedEffect::name, &OmittedEffect::name);
}

double BoundOf(const std::vector<OmittedEffect>& effects) {
  double sum = 0;
  for (const OmittedEffect& effect : effects) sum += effect.bound;
  return sum;
}

void Omit(const std::vector<OmittedEffect>& effects, const RenderSetup& setup) {
  RequiredFeatures plan = setup.scene->Features();
  for (const OmittedEffect& effect : effects)
    for (int i = 0; i < kFeatureCount; ++i)
      if (effect.name == FeatureName(Feature(i)) && plan.Needs(Feature(i)))
        plan.Set(Feature(i), false, "left out by --accuracy");
  setup.scene->SetFeatures(std::move(plan), setup.camera->Shutter());
}

std::vector<OmittedEffect> FindOmissions(const RenderCommand& command, PilotRenderer* pilots,
                                         Candidate* chosen, Log& log) {
  return OmissionFinder(command, pilots, chosen, &log).Find();
}

}  // namespace exphoton::cli
