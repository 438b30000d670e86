// SPDX-License-Identifier: BSD-2-Clause
// SceneRun checks scenes, repeats alarms and counts failures.
#include "tests/random/scenes/run.h"

#include <cmath>
#include <exception>
#include <utility>

#include "tests/random/probes/estimates.h"
#include "tests/random/probes/focused_scene.h"
#include "tests/random/probes/probed_scene.h"
#include "tests/random/probes/rooms.h"
#include "tests/random/scenes/counts.h"
#include "tests/random/scenes/properties.h"
#include "tests/random/scenes/scene_generator.h"
#include "tests/random/scenes/scene_text.h"
#include "tests/random/scenes/shrinking.h"
#include "tests/random/scenes/statistics.h"
#include "tests/random/variations/gathers.h"
#include "tests/random/variations/layers.h"
#include "tests/random/variations/pairs.h"
#include "tests/random/variations/variations.h"

namespace exphoton::random_scenes {
namespace {

constexpr double kFalseAlarms = .05;  // of the first stage
constexpr double kCertain = 1e-6;     // in the second stage
constexpr int kMore = 16;             // in the third stage, times the second
constexpr double kStillThere = 1e-4;  // while shrinking, with the effort of the first stage

bool IsAgreement(const std::string& property) {
  return property == kAgreement || property == kRooms;
}

// Returns the scene whose pictures are compared.
SceneModel AgreementScene(const std::string& property, const SceneModel& drawn,
                          std::uint64_t seed) {
  return property == kRooms ? PhotonRoom(drawn, seed) : drawn;
}

// Returns the text of the scene that an exact property checked.
std::string CheckedText(const std::string& property, const SceneModel& scene, std::uint64_t seed) {
  return SceneText(property == kProbes ? SometimesFocused(scene, seed) : scene, {});
}

std::string Broken(const std::string& property, const SceneModel& scene, std::uint64_t seed) {
  if (property == kVariations) return BrokenVariation(scene, seed);
  return property == kProbes ? BrokenProbe(scene, seed) : BrokenInvariance(scene);
}

std::vector<Comparison> Compared(const std::string& property, const SceneModel& scene,
                                 const Effort& effort, const std::string& only = "") {
  if (property == kEnergy) return CompareWithEnergy(scene, effort);
  if (property == kEstimates) return CompareEstimates(scene, effort);
  if (property == kFurnace) return CompareWithFurnace(scene, effort);
  if (property == kSums) return CompareWithSum(scene, effort);
  if (property == kPairs) return ComparePairs(scene, effort);
  if (property == kPhotons) return ComparePhotons(scene, effort);
  if (property == kLayers) return CompareLayers(scene, effort);
  if (property == kGathers) return CompareGathers(scene, effort);
  Effort more = effort;
  more.comparesMore = property == kRooms;
  return IntegratorComparison(AgreementScene(property, scene, effort.sceneSeed), more)
      .Compare(only);
}

std::string ComparedText(const std::string& property, const SceneModel& scene, std::uint64_t seed) {
  if (property == kEnergy) return EnergyText(scene);
  if (property == kEstimates) return SceneText(SometimesFocused(scene, seed), {});
  if (property == kPairs) return PairText(scene, seed);
  if (property == kPhotons) return PhotonText(scene, seed);
  if (property == kLayers) return LayersText(scene, seed);
  if (property == kGathers) return GathersText(scene, seed);
  if (property == kFurnace || property == kSums) return FurnaceText(ExactFurnace(scene, seed));
  return AgreementText(AgreementScene(property, scene, seed));
}

// Returns the comparison of that name, or one with a p-value of 1 if there is none.
Comparison Named(const std::vector<Comparison>& comparisons, const std::string& what) {
  for (const Comparison& comparison : comparisons)
    if (comparison.what == what) return comparison;
  Comparison none;
  none.what = what;
  return none;
}

}  // namespace

void SceneRun::Add(const std::string& property, std::uint64_t seed) {
  if (property == kVariations || property == kInvariances || property == kProbes)
    Check(property, seed);
  else
    Compare(property, seed);
}

void SceneRun::Check(const std::string& property, std::uint64_t seed) {
  const auto drawn = SceneOfSeed(seed);
  Tally& tally = tallies_[property];
  ++tally.scenes;
  std::string broken = Broken(property, drawn.value(), seed);
  if (broken.empty()) return;
  ++tally.failures;
  SceneModel scene = drawn.value();
  if (settings_.maxTries > 0) {
    const auto fails = [&](const SceneModel& s) { return !Broken(property, s, seed).empty(); };
    scene = Shrink(drawn, fails, settings_.maxTries).scene;
    broken = Broken(property, scene, seed);
  }
  failures_.push_back({seed, property, broken, CheckedText(property, scene, seed)});
}

void SceneRun::Compare(const std::string& property, std::uint64_t seed) {
  ++tallies_[property].scenes;
  const SceneModel scene = SceneOfSeed(seed).value();
  try {
    const Effort effort{.factor = 1, .firstSeed = seed, .sceneSeed = seed};
    for (const Comparison& comparison : Compared(property, scene, effort))
      records_.push_back({seed, property, comparison});
  } catch (const std::exception& error) {
    ++tallies_[property].failures;
    failures_.push_back({seed, property, std::string("an error: ") + error.what(),
                         ComparedText(property, scene, seed)});
  }
}

void SceneRun::JudgeComparisons() {
  std::vector<double> chances;
  for (const Record& record : records_) chances.push_back(record.comparison.chance);
  for (const std::size_t i : Rejected(chances, kFalseAlarms)) Judge(&records_[i]);
}

std::vector<Comparison> SceneRun::CompareAgain(const SceneModel& scene, const Record& record,
                                               int moreFactor) {
  Effort effort{.factor = 16,
                .photonFactor = moreFactor,
                .firstSeed = record.seed + 500'000'000 * std::uint64_t(moreFactor),
                .sceneSeed = record.seed,
                .comparesMore = record.property == kRooms};
  if (!IsAgreement(record.property)) {
    effort.factor *= std::exchange(effort.photonFactor, 1);
    return Compared(record.property, scene, effort);
  }
  if (comparedSeed_ != record.seed || comparedProperty_ != record.property) comparisons_.clear();
  comparedSeed_ = record.seed;
  comparedProperty_ = record.property;
  return comparisons_
      .try_emplace(moreFactor, AgreementScene(record.property, scene, record.seed), effort)
      .first->second.Compare(record.comparison.what);
}

void SceneRun::Judge(Record* record) {
  if (record->isJudged) return;
  record->isJudged = true;
  for (const Failure& failure : failures_)  // one failure per scene and property is enough
    if (failure.seed == record->seed && failure.property == record->property) return;
  ++repeated_;
  const auto drawn = SceneOfSeed(record->seed);
  const std::string what = record->comparison.what;
  const auto look = [&](int moreFactor) {
    return Named(CompareAgain(drawn.value(), *record, moreFactor), what);
  };
  const Comparison again = look(1);
  if (!(again.chance < kCertain)) return;
  const Comparison withMore = look(kMore);
  if (!IsAgreement(record->property)) {
    if (!(withMore.chance < kCertain)) return;
  } else if (std::abs(withMore.difference) < kBlurFalls * std::abs(again.difference)) {
    blurred_.push_back(
        {record->seed, record->property,
         what + ": " + again.detail + "; with 16 times the photons " + withMore.detail,
         ComparedText(record->property, drawn.value(), record->seed)});
    return;
  }
  ++tallies_[record->property].failures;
  const auto fails = [&](const SceneModel& scene) {
    const Effort first{.factor = 1, .firstSeed = record->seed, .sceneSeed = record->seed};
    return Named(Compared(record->property, scene, first, what), what).chance < kStillThere;
  };
  const SceneModel scene = Shrink(drawn, fails, settings_.maxStatisticalTries).scene;
  failures_.push_back({record->seed, record->property, what + ": " + again.detail,
                       ComparedText(record->property, scene, record->seed)});
}

std::string SceneRun::Summary() const {
  return TalliesText(tallies_) +
         "comparisons repeated with 16 times the samples: " + std::to_string(repeated_) +
         "\nof these blur, which falls with more photons: " + std::to_string(blurred_.size()) +
         "\n";
}

}  // namespace exphoton::random_scenes
