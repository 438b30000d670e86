// SPDX-License-Identifier: BSD-2-Clause
#include "core/app/dial/dial.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "core/app/analysis/numbers.h"
#include "core/app/dial/exploration.h"
#include "core/app/dial/omissions.h"
#include "core/base/error.h"
#include "core/base/format.h"
#include "core/base/parallel.h"

namespace exphoton::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kKnown[] = {"path", kGuidedPath, "exphotonmap", "photonmap"};
// In this order: pilots of the first one cost least, and the first two show whether the last one
// may be the cheapest. photonmap was never the cheapest one.
constexpr const char* kAutomatic[] = {"path", "exphotonmap", kGuidedPath};

constexpr std::int64_t kLeastGroup = 2;                     // samples of a group
constexpr double kLeastPass = 4;                            // samples of a pass of a limited number
constexpr std::int64_t kMostFirst = std::int64_t(1) << 40;  // samples of a first group
constexpr double kRoundUp = 1.25;   // groups are rounded up from above 2^k / 1.25
constexpr double kMostGrowth = 64;  // of the samples that the pilots suggest
// Textures are filtered for this number of first groups.
constexpr std::int64_t kFootprintGroups = 128;
constexpr double kMorePhotons = 4, kMostPhotons = 256;
constexpr double kDearer = 2;          // than a rival, whose price comes from small pilots
constexpr double kNotableRatio = 1.1;  // of times
constexpr double kFirstShare = .25;    // of a time limit, for the first group of passes
constexpr double kGroupShare = .1;     // of the price, for photons of more groups
constexpr double kCheapGroups = 3;     // number of groups that this pays for
constexpr double kSharing = 4;         // samples of a group that shares gathers, at least
// The price of a candidate whose rough pilot was cut off is about this many times its least price.
constexpr double kLikelyPrice = 4;

std::vector<std::string> NamesOf(const RenderCommand& command, const std::string& sceneIntegrator) {
  if (command.load.integrator) return {*command.load.integrator};
  if (!command.keepsSettings) return {std::begin(kAutomatic), std::end(kAutomatic)};
  CheckDialIntegrator(sceneIntegrator);
  return {sceneIntegrator};
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

// Returns the numbers of photons that are not the scene's, each with a comma before it.
std::string PhotonsText(const DialSettings& settings) {
  std::string text;
  const auto add = [&](const char* what, double count, double factor) {
    if (count > 0 && factor != 1)
      text += std::string(", ") + Change(what, Count(count), Count(count * factor));
  };
  add("indirect photons", settings.indirectPhotons, settings.photons);
  add("caustic photons", settings.causticPhotons, std::max(settings.photons, 1.));
  return text;
}

// Returns what is chosen, with the settings of the scene before the arrows.
std::string ChoiceText(const PilotRenderer& pilots, const Candidate& chosen, bool stopsSharing) {
  std::string text = Change("integrator", pilots.SceneIntegrator(), chosen.integrator) + ", " +
                     Change("samples a pixel", std::to_string(pilots.SceneSamples()),
                            "about " + Count(chosen.price.samples));
  const DialSettings& settings = chosen.settings;
  text += PhotonsText(settings);
  const int rays = pilots.SceneGatherRays();
  if (settings.gatherRays > 0)
    text += ", " + Change("gather rays", rays > 0 ? std::to_string(rays) : "default",
                          std::to_string(settings.gatherRays));
  if (stopsSharing && ReadsPhotonMaps(chosen.integrator)) text += ", gathers not shared";
  return text;
}

std::string ReasonText(const std::vector<Candidate>& candidates, const Candidate& chosen) {
  std::string text =
      "expected CPU time " + study::SecondsText(chosen.price.seconds * chosen.secondsPerCost);
  for (const Candidate& other : candidates) {
    if (other.integrator == chosen.integrator) continue;
    text += "; " + other.integrator + ": " +
            (other.reason.empty()
                 ? Plain(other.price.seconds / chosen.price.seconds, 2) + " times as much"
                 : other.reason);
  }
  return text;
}

// Returns the lowest price of other candidates, in samples per pixel of the chosen one. An
// integrator that was given up once stays if it is chosen again.
double RivalSamples(const std::vector<Candidate>& candidates, const Candidate& chosen,
                    const std::vector<GivenUp>& given) {
  const auto isChosen = [&](const GivenUp& one) { return one.integrator == chosen.integrator; };
  if (std::ranges::any_of(given, isChosen)) return kNoPrice;
  double price = kNoPrice;
  for (const Candidate& other : candidates) {
    if (other.integrator == chosen.integrator) continue;
    price = std::min(price,
                     other.leastPrice > 0 ? kLikelyPrice * other.leastPrice : other.KnownPrice());
  }
  return price / chosen.priceOfSample;
}

// Compares the settings that --keep keeps with those that would be chosen without it.
std::string CostOfKeeping(PilotRenderer* pilots, const Candidate& kept, Wish wish) {
  wish.keepsPhotons = wish.mayMissLight = false;
  wish.findOmissions = nullptr;
  std::vector<std::string> names(std::begin(kAutomatic), std::end(kAutomatic));
  pilots->Compare(names);
  const Candidate* best = nullptr;
  const std::vector<Candidate> others = ExploreAll(pilots, names, wish);
  for (const Candidate& other : others)
    if (other.reason.empty() && (!best || other.price.seconds < best->price.seconds)) best = &other;
  const double ratio = best ? kept.price.seconds / best->price.seconds : 1;
  if (!(ratio > kNotableRatio))
    return "--keep costs nothing: no other settings are expected to be cheaper";
  return "--keep costs about " + Plain(ratio, 2) + " times the time of other settings (" +
         ChoiceText(*pilots, *best, false) + ")";
}

std::optional<double> SecondsLeft(const RenderCommand& command, Clock::time_point begin) {
  if (!command.timeLimit) return std::nullopt;
  return *command.timeLimit - std::chrono::duration<double>(Clock::now() - begin).count();
}

// A time limit should leave time for two groups. secondsLeft: after the pilots; nullopt: no limit.
std::int64_t FirstSamples(const Candidate& chosen, const RenderCommand& command,
                          std::optional<double> secondsLeft) {
  double size = kRoundUp * chosen.price.samples / GroupsOf(chosen);
  if (secondsLeft) {
    const double cpuSeconds = chosen.price.seconds * chosen.secondsPerCost;
    const double seconds = cpuSeconds / ThreadPool(command.threadCount).Count();
    size =
        std::min(size, kFirstShare * std::max(*secondsLeft, 0.) / seconds * chosen.price.samples);
  }
  // Each of a limited number of passes has photons of its own.
  size = std::max(size, command.maxPasses > 0 ? kLeastPass : 1.);
  return std::max(kLeastGroup, std::int64_t(std::bit_floor(std::uint64_t(size))));
}

// Returns the limit of a picture that should take this number of samples. Pilots that ask for a few
// samples know little about rare bright ones.
std::int64_t MostSamples(double expected) {
  constexpr double kFew = 16;
  const double most = kMostGrowth * std::max(expected, kFew);
  return std::int64_t(std::min(most, double(kMostFirst)));
}

// States how many passes the accuracy is likely to take (--max-passes). A pass that is rendered in
// vain costs as much as one that is needed, so the number should not be far above it.
void ReportPasses(const RenderCommand& command, Log& log) {
  const DialChoice& dial = *command.dial;
  const double needed = std::max(std::ceil(dial.expectedSamples / double(dial.firstSamples)), 2.);
  log.Notice(Format("a pass has %s a pixel, and about %.0f passes are likely to be enough",
                    Counted(dial.firstSamples, "sample").c_str(), needed));
  if (needed > command.maxPasses)
    log.Warning(Format("--max-passes %d is likely to end the picture before its accuracy of %.3g%%",
                       command.maxPasses, 100 * *command.accuracy),
                {}, Format("about %.0f passes are likely to be enough", needed));
}

void Apply(const DialSettings& settings, RenderCommand* command) {
  for (ParameterOverride& parameter : settings.Overrides())
    command->load.parameters.push_back(std::move(parameter));
}

// Names the integrators that are compared, and stops the sharing of passes of a limited number:
// they would share their gathers alone, and the bias would stay however many passes there are.
// Returns whether it has stopped.
bool PrepareForPilots(RenderCommand* command) {
  if (!command->load.integrator && !command->keepsSettings)
    command->load.comparedIntegrators = {std::begin(kAutomatic), std::end(kAutomatic)};
  const auto& integrator = command->load.integrator;
  if (command->maxPasses == 0 || command->keepsSettings) return false;
  if (integrator && !ReadsPhotonMaps(*integrator)) return false;
  command->load.parameters.push_back({"SurfaceIntegrator", "sharedgather", "false"});
  return true;
}

// Replaces settings, which are the last parameters of the command. Settings of the scene have no
// parameters, so the earlier ones must go.
void Replace(const DialSettings& earlier, const DialSettings& settings, RenderCommand* command) {
  auto& parameters = command->load.parameters;
  parameters.erase(parameters.end() - std::ptrdiff_t(earlier.Overrides().size()), parameters.end());
  Apply(settings, command);
}

// Each of a limited number of passes has the samples of the sampler. Textures are filtered for all
// passes together.
void SetFirstSamples(std::int64_t samples, RenderCommand* command) {
  const int passes = command->maxPasses;
  command->dial->firstSamples = samples;
  command->load.samplesPerPixel = passes > 0 ? samples : kFootprintGroups * samples;
  if (passes > 0 && command->footprintSamples == 0) command->footprintSamples = samples * passes;
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
  const std::string before = PhotonsText(earlier);
  const std::size_t at = before.empty() ? std::string::npos : dial.text.find(before);
  dial.text.replace(std::min(at, dial.text.size()), before.size(), PhotonsText(settings));
  return settings.photons == 1 ? "all photons of the scene"
                               : Format("%.3g times the photons of the scene", settings.photons);
}

Wish WishOf(const RenderCommand& command, bool isForOneIntegrator,
            std::function<std::vector<OmittedEffect>(Candidate*)> findOmissions) {
  Wish wish;
  wish.error = *command.accuracy;
  wish.keepsPhotons = command.keepsSettings;
  wish.isTimed = command.timeLimit.has_value();
  wish.mayMissLight = isForOneIntegrator;
  wish.findOmissions = std::move(findOmissions);
  wish.givenUp = command.givenUp;
  return wish;
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
  const bool stopsSharing = PrepareForPilots(turned);
  const RenderCommand command = *turned;
  const Clock::time_point begin = Clock::now();
  const std::string accuracy = Format("%.3g%%", 100 * *command.accuracy);
  if (command.load.integrator) CheckDialIntegrator(*command.load.integrator);
  const auto renderer = std::make_shared<PilotRenderer>(
      command, scene, PilotRenderer::Surroundings{"--accuracy", streams, &log, true, true});
  PilotRenderer& pilots = *renderer;
  const std::vector<std::string> names = NamesOf(command, pilots.SceneIntegrator());
  const auto findOmissions = [&](Candidate* candidate) {
    return FindOmissions(command, &pilots, candidate, log);
  };
  const Wish wish = WishOf(command, names.size() == 1, findOmissions);
  const std::vector<Candidate> candidates =
      names.size() > 1 ? ExploreAll(&pilots, names, wish)
                       : std::vector{ExploreNamed(&pilots, names.front(), wish)};
  Candidate chosen = CheapestOf(candidates, accuracy);
  if (!chosen.hasSoughtOmissions) chosen.omitted = findOmissions(&chosen);
  turned->load.integrator = chosen.integrator;
  turned->dial =
      DialChoice{.firstSamples = FirstSamples(chosen, command, SecondsLeft(command, begin)),
                 .biasShare = chosen.biasShare,
                 .photonSamples = chosen.photonSamples,
                 .settings = chosen.settings,
                 .omitted = chosen.omitted,
                 .lackingShare = chosen.lackingShare,
                 .text = ChoiceText(pilots, chosen, stopsSharing),
                 .expectedSamples = chosen.price.samples,
                 .mostSamples = MostSamples(chosen.price.samples),
                 .mayRaisePhotons = !command.keepsSettings && command.maxPasses == 0 &&
                                    MayRaisePhotons(chosen.settings),
                 .earlierLooks = command.givenUp.empty() ? 0 : command.givenUp.back().looks,
                 .rivalSamples = RivalSamples(candidates, chosen, command.givenUp)};
  Apply(chosen.settings, turned);
  SetFirstSamples(turned->dial->firstSamples, turned);
  turned->certifies = chosen.correctedShare > 0;
  turned->certifiedShare = turned->certifies ? chosen.correctedShare : turned->certifiedShare;
  log.Notice("accuracy " + accuracy + ": " + turned->dial->text);
  // A merge repeats the messages of all shards, and their clocks differ.
  const std::string reason = ReasonText(candidates, chosen);
  command.shard ? log.Verbose(reason) : log.Notice(reason);
  if (command.maxPasses > 0) ReportPasses(*turned, log);
  for (const OmittedEffect& effect : chosen.omitted) log.Notice(TextOf(effect));
  if (command.keepsSettings) log.Notice(CostOfKeeping(&pilots, chosen, wish));
  return renderer;
}

// With a time limit there is no second choice, because the first picture has taken time.
std::optional<double> TooManySamples(const RenderCommand& command) {
  const DialChoice& dial = *command.dial;
  if (!dial.mayRaisePhotons || command.timeLimit) return std::nullopt;
  const double samples = kMorePhotons * dial.photonSamples + dial.expectedSamples;
  if (!(samples > kDearer * dial.rivalSamples)) return std::nullopt;
  return samples - dial.photonSamples;  // which another choice counts apart
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
