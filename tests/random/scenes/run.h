// SPDX-License-Identifier: BSD-2-Clause
// SceneRun tests random scenes: it checks the properties of each, repeats alarms of the statistical
// ones, shrinks failing scenes, and counts.
//
// The blur of a photon map is a documented bias, but it has no bound. An emitter in a closed body
// lights the outside of the body through its edges, which is a large error in a dark room. Blur
// goes to 0 as the number of photons grows; errors of light transport do not. A repeated alarm is
// therefore tested in a third stage with 16 times the photons, which reduces the radius to 1/4. If
// the difference falls below kBlurFalls of its former value, it is counted as blur and not as a
// failure. This misses a lasting error e only if blur exceeds 1.14 e.
//
// Other comparisons are tested in a third stage with 256 times the samples. Where few samples find
// a light, all pictures of one method can be nearly black in the second stage, and a t-test takes
// their equal means for a small error.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

struct Failure {
  std::uint64_t seed = 0;
  std::string property, detail;
  std::string text;  // the scene file, after shrinking
};

// Tally counts how often a property was checked and how often it failed.
struct Tally {
  int scenes = 0, failures = 0;
};

inline constexpr double kBlurFalls = .6;

// The properties. The first three are exact, the others are comparisons of means.
inline const std::string kVariations = "variations", kInvariances = "invariances",
                         kProbes = "probes";
inline const std::string kEnergy = "energy", kEstimates = "estimates", kFurnace = "furnace",
                         kSums = "sums", kPairs = "pairs", kPhotons = "photons", kRooms = "rooms",
                         kLayers = "layers", kGathers = "gathers", kAgreement = "agreement";

struct RunSettings {
  int maxTries = 300;            // for shrinking by exact properties; 0: none
  int maxStatisticalTries = 60;  // for shrinking by a comparison of means
};

class SceneRun {
 public:
  explicit SceneRun(RunSettings settings) : settings_(settings) {}

  void CheckInvariances(std::uint64_t seed) { Check(kInvariances, seed); }
  void CheckProbes(std::uint64_t seed) { Check(kProbes, seed); }
  void CompareEnergy(std::uint64_t seed) { Compare(kEnergy, seed); }
  void CompareAgreement(std::uint64_t seed) { Compare(kAgreement, seed); }
  // Checks a property of a scene: its exact ones, or its comparisons, which are judged later.
  void Add(const std::string& property, std::uint64_t seed);
  // Repeats each comparison so far that the Benjamini-Hochberg rule rejects, with fresh seeds and
  // 16 times the samples. The comparison is a failure if its p-value is then below 1e-6. Call this
  // now and then, and at the end.
  void JudgeComparisons();

  const std::vector<Failure>& Failures() const { return failures_; }
  const std::map<std::string, Tally>& Tallies() const { return tallies_; }
  int Repeated() const { return repeated_; }
  // Repeated alarms that fell with more photons and so were blur.
  const std::vector<Failure>& Blurred() const { return blurred_; }
  // Returns a line for each property: "invariances: 200 scenes, 0 failures; rate at most 1.5 %
  // (95 %)".
  std::string Summary() const;

 private:
  struct Record {
    std::uint64_t seed;
    std::string property;
    Comparison comparison;
    bool isJudged = false;
  };
  void Check(const std::string& property, std::uint64_t seed);
  void Compare(const std::string& property, std::uint64_t seed);
  void Judge(Record* record);
  // Compares with 16 times the samples and moreFactor times the photons. Properties without photons
  // have 16 * moreFactor times the samples. The pictures of a scene are kept for all of its alarms.
  std::vector<Comparison> CompareAgain(const SceneModel& scene, const Record& record,
                                       int moreFactor);

  RunSettings settings_;
  std::vector<Record> records_;
  std::vector<Failure> failures_, blurred_;
  std::map<std::string, Tally> tallies_;
  std::map<int, IntegratorComparison> comparisons_;  // by moreFactor, for comparedSeed_
  std::uint64_t comparedSeed_ = 0;
  std::string comparedProperty_;
  int repeated_ = 0;
};

}  // namespace exphoton::random_scenes
