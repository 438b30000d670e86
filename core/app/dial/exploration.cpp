// SPDX-License-Identifier: BSD-2-Clause
// Exploration: the order of the pilots, and the light that candidates lack.
#include "core/app/dial/exploration.h"

#include <algorithm>

namespace exphoton::cli {
namespace {

constexpr double kNotableOmission = .005;  // root of relMSE
// A rough pilot has a tenth of the photons and few pixels, so its light is known to about this. A
// wrong suspicion only costs a pilot.
constexpr LightTest kFarMore{.leastMissing = .1, .mostChance = .02};
// The same without a pilot of full size that would confirm it.
constexpr LightTest kSurelyMore{.leastMissing = .2, .mostChance = 6.3e-5};
// So much light is suspicious, whatever its noise: where few photons leave the surroundings of a
// lamp, the noise of a small pilot is hardly known. A rough pilot with more samples follows, which
// dilutes a single bright sample. (A difference above the least one has a chance below a half.)
constexpr LightTest kHalfMore{.leastMissing = 1. / 3, .mostChance = .5};
// Shared gathers need few rays at a point, and more points bring more (docs/decisions/0055). Fewer
// rays would make the bias of sharing uncertain.
constexpr int kGatherRays = 16;
// Its photons find light that paths from the camera hardly ever meet.
constexpr const char* kPhotonWitness = "exphotonmap";

// The means of rough pilots say little, and so do those of pilots that lack much light on purpose.
bool HasWholeLight(const Candidate& candidate) {
  return !candidate.isRough && BoundOf(candidate.omitted) < kNotableOmission;
}

// A candidate that does not find all light has no price.
void DropDarkOnes(std::vector<Candidate>* candidates) {
  std::vector<PilotMean> means;
  for (const Candidate& candidate : *candidates)
    if (!candidate.isRough && candidate.mean.light.mean > 0) means.push_back(candidate.mean);
  for (Candidate& candidate : *candidates)
    if (HasWholeLight(candidate) && candidate.reason.empty() && !means.empty()) {
      candidate.reason = MissingLight(candidate.mean, means);
      if (candidate.reason.empty())
        candidate.reason = MissingLight(candidate.mean, means, kFarMore);
    }
}

// Returns the rays as in DialSettings. Sharing is the reason for more rays than the scene has.
int GatherRaysFor(const std::string& integrator, const PilotRenderer& pilots) {
  const int rays = pilots.SceneGatherRays();
  const bool keepsFew = rays > 0 && rays <= kGatherRays && !pilots.SceneSharesGathers();
  return ReadsPhotonMaps(integrator) && rays != kGatherRays && !keepsFew ? kGatherRays : 0;
}

bool IsCheaper(const Explorer& a, const Explorer& b) {
  return a.Result().KnownPrice() < b.Result().KnownPrice();
}

bool HasRivals(const Explorer& explorer, const std::vector<Explorer>& all) {
  return std::ranges::any_of(all, [&](const Explorer& other) {
    return &other != &explorer && explorer.Result().IsRivalOf(other.Result());
  });
}

std::vector<Candidate> LikelyResults(const std::vector<Explorer>& explorers) {
  std::vector<Candidate> results;
  for (const Explorer& explorer : explorers) results.push_back(explorer.LikelyResult());
  return results;
}

std::vector<Candidate> ResultsOf(const std::vector<Explorer>& explorers) {
  std::vector<Candidate> results;
  for (const Explorer& explorer : explorers) results.push_back(explorer.Result());
  return results;
}

// Explores candidates that have a first price, where the lowest price of others is `most`. The
// cheapest one comes first in each round.
void Explore(std::vector<Explorer>* explorers, double most) {
  const auto best = [&] {
    return std::min(most, std::ranges::min_element(*explorers, IsCheaper)->Result().KnownPrice());
  };
  std::ranges::stable_sort(*explorers, IsCheaper);
  for (Explorer& explorer : *explorers)
    if (explorer.FindOmissions(best())) break;
  for (Explorer& explorer : *explorers) explorer.Settle(best());
  std::ranges::stable_sort(*explorers, IsCheaper);
  for (Explorer& explorer : *explorers) explorer.Refine(best(), HasRivals(explorer, *explorers));
}

double LowestPrice(const std::vector<Candidate>& candidates) {
  double lowest = kNoPrice;
  for (const Candidate& candidate : candidates) lowest = std::min(lowest, candidate.KnownPrice());
  return lowest;
}

// Returns whether a candidate without a first price may still be the cheapest.
bool MayWin(const Candidate& leftOut, const PilotRenderer& pilots,
            const std::vector<Candidate>& others) {
  if (leftOut.leastPrice > 0) return leftOut.leastPrice < LowestPrice(others);
  return pilots.HasIndirectLight() && MayGuidingWin(others);
}

Explorer MakeExplorer(PilotRenderer* pilots, const std::string& name, const Wish& wish) {
  return {pilots, name, wish.keepsPhotons ? 0 : GatherRaysFor(name, *pilots), wish};
}

// Returns why this integrator needs no pilot; nullopt: it needs one. Without indirect light,
// guidedpath renders what path renders.
std::optional<std::string> WhyNoGuiding(const std::string& integrator, const PilotRenderer& pilots,
                                        const std::vector<Explorer>& explorers) {
  if (integrator != kGuidedPath) return std::nullopt;
  if (!pilots.HasIndirectLight()) return "no pilot, because there is no indirect light to guide";
  if (!MayGuidingWin(LikelyResults(explorers))) return "no pilot, because path costs far more";
  return std::nullopt;
}

// Returns the explorers of candidates with a first price. The others go to `leftOut`: those whose
// photons cost more than an earlier candidate, and guidedpath where it cannot be the cheapest.
std::vector<Explorer> BeginAll(PilotRenderer* pilots, const std::vector<std::string>& names,
                               const Wish& wish, std::vector<Candidate>* leftOut) {
  std::vector<Explorer> explorers;
  for (const std::string& name : names) {
    if (const auto reason = WhyNoGuiding(name, *pilots, explorers)) {
      leftOut->push_back({.integrator = name, .reason = *reason});
      continue;
    }
    double most = kNoPrice;
    for (const Explorer& other : explorers) most = std::min(most, other.Result().KnownPrice());
    Explorer explorer = MakeExplorer(pilots, name, wish);
    explorer.Begin(most);
    if (explorer.Result().leastPrice > 0)
      leftOut->push_back(explorer.Result());
    else
      explorers.push_back(std::move(explorer));
  }
  return explorers;
}

// Returns whether the rough pilot found more light than the pilot of a candidate with a price.
bool ShowsMoreLight(const Candidate& rough, const std::vector<Candidate>& others,
                    const LightTest& test) {
  if (!(rough.mean.light.mean > 0)) return false;
  return std::ranges::any_of(others, [&](const Candidate& other) {
    const PilotMean means[] = {other.mean, rough.mean};
    return HasWholeLight(other) && other.reason.empty() &&
           !MissingLight(other.mean, means, test).empty();
  });
}

// A pilot of full size decides where a rough one finds far more light than another integrator,
// which may then lack light, so that its price is wrong.
void SettleBrightOnes(std::vector<Explorer>* explorers, const std::vector<Candidate>& others) {
  for (Explorer& explorer : *explorers) {
    const auto showsMore = [&](const LightTest& test) {
      return explorer.Result().isRough && ShowsMoreLight(explorer.Result(), others, test);
    };
    if (!showsMore(kFarMore) && showsMore(kHalfMore)) explorer.LookAgain();
    if (showsMore(kFarMore) || (explorer.HasLookedAgain() && showsMore(kHalfMore)))
      explorer.SettleLight();
  }
}

// Returns the results, without those that lack light. The cheapest one has a pilot of full size.
std::vector<Candidate> SettleCheapest(std::vector<Explorer>* explorers) {
  for (;;) {
    SettleBrightOnes(explorers, ResultsOf(*explorers));
    std::vector<Candidate> candidates = ResultsOf(*explorers);
    if (candidates.size() > 1) DropDarkOnes(&candidates);
    const auto best = std::ranges::min_element(candidates, {}, &Candidate::KnownPrice);
    if (!best->isRough || !(best->KnownPrice() < kNoPrice)) return candidates;
    (*explorers)[std::size_t(best - candidates.begin())].Settle(kNoPrice);
  }
}

// Returns whether an integrator may fail to meet light that photons find.
bool HasWitness(const std::string& integrator) {
  return integrator == "path" || integrator == kGuidedPath;
}

}  // namespace

Candidate ExploreNamed(PilotRenderer* pilots, const std::string& name, const Wish& wish) {
  const bool hasWitness = HasWitness(name) && pilots->HasSpecularSurfaces() &&
                          pilots->UnseenLight({.integrator = name}).empty();
  Candidate named = ExploreAll(pilots, {name}, wish).front();
  if (!hasWitness || !named.reason.empty()) return named;
  Explorer witness = MakeExplorer(pilots, kPhotonWitness, wish);
  witness.Begin(named.KnownPrice());
  const PilotMean& seen = witness.Result().mean;
  const PilotMean means[] = {named.mean, seen};
  if (seen.light.mean > 0 && !MissingLight(named.mean, means, kSurelyMore).empty())
    named.lackingShare = 1 - named.mean.light.mean / seen.light.mean;
  return named;
}

std::vector<Candidate> ExploreAll(PilotRenderer* pilots, const std::vector<std::string>& names,
                                  const Wish& wish) {
  std::vector<Candidate> leftOut, skipped;
  std::vector<Explorer> explorers = BeginAll(pilots, names, wish, &leftOut);
  Explore(&explorers, kNoPrice);
  for (const Candidate& candidate : leftOut) {
    const std::vector<Candidate> others = SettleCheapest(&explorers);
    if (!MayWin(candidate, *pilots, others) && !ShowsMoreLight(candidate, others, kFarMore)) {
      skipped.push_back(candidate);
      continue;
    }
    std::vector<Explorer> late{MakeExplorer(pilots, candidate.integrator, wish)};
    late.front().Begin();
    Explore(&late, LowestPrice(others));
    SettleBrightOnes(&late, others);
    explorers.push_back(std::move(late.front()));
  }
  std::vector<Candidate> candidates = SettleCheapest(&explorers);
  candidates.insert(candidates.end(), skipped.begin(), skipped.end());
  return candidates;
}

}  // namespace exphoton::cli
