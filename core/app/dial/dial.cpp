// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/dial.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/app/analysis/numbers.h"
#include "core/app/dial/candidate.h"
#include "core/app/dial/omissions.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/base/parallel.h"

namespace exphoton::cli {
namespace {

constexpr const char* kGuided = "guidedpath";
constexpr const char* kKnown[] = {"path", kGuided, "exphotonmap", "photonmap"};
// In this order: pilots of the first one cost least, and the first two show whether the last one
// may be the cheapest. photonmap was never the cheapest one.
constexpr const char* kAutomatic[] = {"path", "exphotonmap", kGuided};

constexpr std::int64_t kLeastGroup = 2;                     // samples of a group
constexpr std::int64_t kMostFirst = std::int64_t(1) << 40;  // samples of a first group
constexpr double kRoundUp = 1.25;         // groups are rounded up from above 2^k / 1.25
constexpr std::int64_t kMostGrowth = 64;  // of the samples that the pilots suggest
constexpr double kMorePhotons = 4, kMostPhotons = 256;
constexpr double kNotableRatio = 1.1;      // of times
constexpr double kNotableOmission = .005;  // root of relMSE
constexpr double kFirstShare = .25;        // of a time limit, for the first group of passes
constexpr double kGroupShare = .1;         // of the price, for photons of more groups
constexpr double kCheapGroups = 3;         // number of groups that this pays for
constexpr double kSharing = 4;             // samples of a group that shares gathers, at least
// Shared gathers need few rays at a point, and more points bring more (docs/decisions/0055). Fewer
// rays would make the bias of sharing uncertain.
constexpr int kGatherRays = 16;

std::vector<std::string> NamesOf(const RenderCommand& command, const std::string& sceneIntegrator) {
  if (command.load.integrator) return {*command.load.integrator};
  if (!command.keepsSettings) return {std::begin(kAutomatic), std::end(kAutomatic)};
  CheckDialIntegrator(sceneIntegrator);
  return {sceneIntegrator};
}

// A candidate that does not find all light has no price. The means of rough pilots say little, and
// so do those of pilots that lack much light on purpose.
void DropDarkOnes(std::vector<Candidate>* candidates) {
  std::vector<PilotMean> means;
  for (const Candidate& candidate : *candidates)
    if (!candidate.isRough && candidate.mean.light.mean > 0) means.push_back(candidate.mean);
  for (Candidate& candidate : *candidates)
    if (!candidate.isRough && candidate.reason.empty() && !means.empty() &&
        BoundOf(candidate.omitted) < kNotableOmission)
      candidate.reason = MissingLight(candidate.mean, means);
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

// Explores candidates that have a first price, where the lowest price of others is `most`. The
// cheapest one comes first in each round.
std::vector<Candidate> Explore(std::vector<Explorer>* explorers, double most) {
  const auto best = [&] {
    return std::min(most, std::ranges::min_element(*explorers, IsCheaper)->Result().KnownPrice());
  };
  std::ranges::stable_sort(*explorers, IsCheaper);
  for (Explorer& explorer : *explorers)
    if (explorer.FindOmissions(best())) break;
  for (Explorer& explorer : *explorers) explorer.Settle(best());
  std::ranges::stable_sort(*explorers, IsCheaper);
  std::vector<Candidate> candidates;
  for (Explorer& explorer : *explorers) {
    explorer.Refine(best(), HasRivals(explorer, *explorers));
    candidates.push_back(explorer.Result());
  }
  return candidates;
}

double LowestPrice(const std::vector<Candidate>& candidates) {
  double lowest = kNoPrice;
  for (const Candidate& candidate : candidates) lowest = std::min(lowest, candidate.KnownPrice());
  return lowest;
}

// Returns whether a candidate without a first price may still be the cheapest.
bool MayWin(const Candidate& leftOut, const std::vector<Candidate>& others) {
  if (leftOut.leastPrice > 0) return leftOut.leastPrice < LowestPrice(others);
  return MayGuidingWin(others);
}

Explorer MakeExplorer(PilotRenderer* pilots, const std::string& name, const Wish& wish) {
  return {pilots, name, wish.keepsPhotons ? 0 : GatherRaysFor(name, *pilots), wish};
}

// Returns the explorers of candidates with a first price. The others go to `leftOut`: those whose
// photons cost more than an earlier candidate, and guidedpath where it cannot be the cheapest.
std::vector<Explorer> BeginAll(PilotRenderer* pilots, const std::vector<std::string>& names,
                               const Wish& wish, std::vector<Candidate>* leftOut) {
  std::vector<Explorer> explorers;
  for (const std::string& name : names) {
    if (name == kGuided && !MayGuidingWin(LikelyResults(explorers))) {
      Candidate guided;
      guided.integrator = kGuided;
      guided.reason = "no pilot, because path costs far more";
      leftOut->push_back(guided);
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

// First prices of all candidates come before any of them is explored further, so that a dear one
// gets small pilots only. Candidates that were left out are explored if the others turn out to cost
// more.
std::vector<Candidate> ExploreAll(PilotRenderer* pilots, const std::vector<std::string>& names,
                                  const Wish& wish) {
  std::vector<Candidate> leftOut;
  std::vector<Explorer> explorers = BeginAll(pilots, names, wish, &leftOut);
  std::vector<Candidate> candidates = Explore(&explorers, kNoPrice);
  if (candidates.size() > 1) DropDarkOnes(&candidates);
  for (const Candidate& candidate : leftOut) {
    if (!MayWin(candidate, candidates)) {
      candidates.push_back(candidate);
      continue;
    }
    std::vector<Explorer> late{MakeExplorer(pilots, candidate.integrator, wish)};
    late.front().Begin();
    candidates.push_back(Explore(&late, LowestPrice(candidates)).front());
    DropDarkOnes(&candidates);
  }
  return candidates;
}

const Candidate& CheapestOf(const std::vector<Candidate>& candidates, const std::string& accuracy) {
  const Candidate* best = nullptr;
  std::string reasons;
  for (const Candidate& candidate : candidates) {
    if (!candidate.reason.empty())
      reasons += (reasons.empty() ? "" : "; ") + candidate.integrator + ": " + candidate.reason;
    else if (!best || candidate.price.seconds < best->price.seconds)
      best = &candidate;
  }
  if (best) return *best;
  throw Error(ExitStatus::CommandLine, "--accuracy " + accuracy + " is out of reach: " + reasons,
              {}, "--integrator guidedpath has no bias, and a larger percentage is cheaper");
}

std::string Change(const char* what, const std::string& from, const std::string& to) {
  return std::string(what) + " " + (from == to ? from : from + " -> " + to);
}

std::string Count(double number) { return std::to_string(std::int64_t(number)); }

// Returns what is chosen, with the settings of the scene before the arrows.
std::string ChoiceText(const PilotRenderer& pilots, const Candidate& chosen) {
  std::string text = Change("integrator", pilots.SceneIntegrator(), chosen.integrator) + ", " +
                     Change("samples a pixel", std::to_string(pilots.SceneSamples()),
                            "about " + Count(chosen.price.samples));
  const DialSettings& settings = chosen.settings;
  const auto photons = [&](const char* what, double count, double factor) {
    if (count > 0 && factor != 1) text += ", " + Change(what, Count(count), Count(count * factor));
  };
  photons("indirect photons", settings.indirectPhotons, settings.photons);
  photons("caustic photons", settings.causticPhotons, std::max(settings.photons, 1.));
  const int rays = pilots.SceneGatherRays();
  if (settings.gatherRays > 0)
    text += ", " + Change("gather rays", rays > 0 ? std::to_string(rays) : "default",
                          std::to_string(settings.gatherRays));
  return text;
}

std::string ReasonText(const std::vector<Candidate>& candidates, const Candidate& chosen) {
  std::string text =
      "expected CPU time " + study::SecondsText(chosen.price.seconds * chosen.secondsPerCost);
  for (const Candidate& other : candidates) {
    if (other.integrator == chosen.integrator) continue;
    text += "; " + other.integrator + ": " +
            (other.reason.empty()
                 ? Format("%.2g times as much", other.price.seconds / chosen.price.seconds)
                 : other.reason);
  }
  return text;
}

// Compares the settings that --keep keeps with those that would be chosen without it.
std::string CostOfKeeping(PilotRenderer* pilots, const Candidate& kept, Wish wish) {
  wish.keepsPhotons = false;
  wish.findOmissions = nullptr;
  std::vector<std::string> names(std::begin(kAutomatic), std::end(kAutomatic));
  const Candidate* best = nullptr;
  const std::vector<Candidate> others = ExploreAll(pilots, names, wish);
  for (const Candidate& other : others)
    if (other.reason.empty() && (!best || other.price.seconds < best->price.seconds)) best = &other;
  const double ratio = best ? kept.price.seconds / best->price.seconds : 1;
  if (!(ratio > kNotableRatio))
    return "--keep costs nothing: no other settings are expected to be cheaper";
  return Format("--keep costs about %.2g times the time of other settings (", ratio) +
         ChoiceText(*pilots, *best) + ")";
}

// A time limit should leave time for two groups.
std::int64_t FirstSamples(const Candidate& chosen, const RenderCommand& command) {
  double size = kRoundUp * chosen.price.samples / GroupsOf(chosen);
  if (command.timeLimit) {
    const double cpuSeconds = chosen.price.seconds * chosen.secondsPerCost;
    const double seconds = cpuSeconds / ThreadPool(command.threadCount).Count();
    size = std::min(size, kFirstShare * *command.timeLimit / seconds * chosen.price.samples);
  }
  size = std::max(size, 1.);
  return std::max(kLeastGroup, std::int64_t(std::bit_floor(std::uint64_t(size))));
}

void Apply(const DialSettings& settings, RenderCommand* command) {
  for (ParameterOverride& parameter : settings.Overrides())
    command->load.parameters.push_back(std::move(parameter));
}

// Replaces settings, which are the last parameters of the command. Settings of the scene have no
// parameters, so the earlier ones must go.
void Replace(const DialSettings& earlier, const DialSettings& settings, RenderCommand* command) {
  auto& parameters = command->load.parameters;
  parameters.erase(parameters.end() - std::ptrdiff_t(earlier.Overrides().size()), parameters.end());
  Apply(settings, command);
}

void SetFirstSamples(std::int64_t samples, RenderCommand* command) {
  command->dial->firstSamples = samples;
  command->load.samplesPerPixel = 2 * kMostGrowth * samples;
}

// Returns whether the scene has photons, and would not have too many of them.
bool MayRaisePhotons(const DialSettings& settings) {
  const bool hasPhotons = settings.indirectPhotons + settings.causticPhotons > 0;
  return hasPhotons && settings.photons * kMorePhotons <= kMostPhotons;
}

// Returns the text of the new setting; nullopt: the dial must not multiply the photons.
std::optional<std::string> MultiplyPhotons(RenderCommand* command) {
  DialChoice& dial = *command->dial;
  if (!dial.mayRaisePhotons) return std::nullopt;
  DialSettings& settings = dial.settings;
  const DialSettings earlier = settings;
  dial.photonSamples *= kMorePhotons;
  settings.photons *= kMorePhotons;
  dial.mayRaisePhotons = MayRaisePhotons(settings);
  Replace(earlier, settings, command);
  std::string text = settings.photons == 1
                         ? "all photons of the scene"
                         : Format("%.3g times the photons of the scene", settings.photons);
  dial.text += ", " + text;
  return text;
}

}  // namespace

// Many groups can stop before the picture is better than wanted, because the noise of pilots is
// uncertain. But each group has to shoot photons, unless those of the first groups turn out to be
// good enough. Small groups share few gathers, so they are noisy and say little about the bias of
// sharing.
double GroupsOf(const Candidate& chosen) {
  const bool sharesGathers = chosen.correctedShare > 0;
  const double most = sharesGathers ? std::clamp(chosen.price.samples / kSharing, 2., 4.) : 16;
  const double oneSet = chosen.photonSamples / (chosen.photonSamples + chosen.price.samples);
  const double cheap = 2 + kGroupShare / std::max(oneSet, 1e-6);
  const bool isCheap = chosen.price.sets == 1 || cheap > kCheapGroups;
  const double least = chosen.hasScatter && isCheap ? 4 : 2;
  return std::floor(std::clamp(cheap, std::min(least, most), most));
}

void CheckDialIntegrator(const std::string& integrator) {
  if (std::ranges::find(kKnown, integrator) != std::end(kKnown)) return;
  throw Error(ExitStatus::CommandLine,
              "--accuracy: the error of integrator \"" + integrator + "\" cannot be estimated", {},
              "--integrator takes path, guidedpath, photonmap or exphotonmap");
}

std::shared_ptr<PilotRenderer> TurnDial(RenderCommand* turned, const std::string& scene,
                                        FileSource::Streams* streams, Log& log) {
  const RenderCommand command = *turned;
  const std::string accuracy = Format("%.3g%%", 100 * *command.accuracy);
  if (command.load.integrator) CheckDialIntegrator(*command.load.integrator);
  const auto renderer = std::make_shared<PilotRenderer>(
      command, scene, PilotRenderer::Surroundings{"--accuracy", streams, &log, true});
  PilotRenderer& pilots = *renderer;
  const std::vector<std::string> names = NamesOf(command, pilots.SceneIntegrator());
  const Wish wish{*command.accuracy, command.keepsSettings, [&](Candidate* candidate) {
                    return FindOmissions(command, &pilots, candidate, log);
                  }};
  const std::vector<Candidate> candidates = ExploreAll(&pilots, names, wish);
  Candidate chosen = CheapestOf(candidates, accuracy);
  if (!chosen.hasSoughtOmissions) chosen.omitted = FindOmissions(command, &pilots, &chosen, log);
  turned->load.integrator = chosen.integrator;
  turned->dial = DialChoice{FirstSamples(chosen, command),
                            chosen.biasShare,
                            chosen.photonSamples,
                            chosen.settings,
                            chosen.omitted,
                            ChoiceText(pilots, chosen),
                            chosen.price.samples,
                            !command.keepsSettings && MayRaisePhotons(chosen.settings)};
  Apply(chosen.settings, turned);
  SetFirstSamples(turned->dial->firstSamples, turned);
  turned->certifies = chosen.correctedShare > 0;
  turned->certifiedShare = turned->certifies ? chosen.correctedShare : turned->certifiedShare;
  log.Notice("accuracy " + accuracy + ": " + turned->dial->text);
  log.Notice(ReasonText(candidates, chosen));
  for (const OmittedEffect& effect : chosen.omitted) log.Notice(TextOf(effect));
  if (command.keepsSettings) log.Notice(CostOfKeeping(&pilots, chosen, wish));
  return renderer;
}

bool RaisePhotons(int looks, RenderCommand* command, Log& log) {
  const auto text = MultiplyPhotons(command);
  if (!text) return false;
  command->dial->earlierLooks = looks;
  log.Notice("the bias is too large for the accuracy, so the picture is rendered again with " +
             *text);
  return true;
}

bool ContinueChoice(const LaterChoice& stopped, RenderCommand* command, Log& log) {
  DialChoice& dial = *command->dial;
  bool hasChanged = false;
  while (stopped.photons > dial.settings.photons) {
    const auto text = MultiplyPhotons(command);
    if (!text) break;
    hasChanged = true;
    log.Notice(
        "the bias was too large for the accuracy, so the stopped render had begun again with " +
        *text);
  }
  const bool isByClock = command->timeLimit && stopped.firstSamples >= kLeastGroup &&
                         stopped.firstSamples <= kMostFirst;
  if (!isByClock || stopped.firstSamples == dial.firstSamples) return hasChanged;
  SetFirstSamples(stopped.firstSamples, command);
  return true;
}

}  // namespace exphoton::cli
