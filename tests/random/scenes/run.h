// SPDX-License-Identifier: BSD-2-Clause
// A run over random scenes: checks the properties of each, repeats alarms of the statistical ones,
// shrinks what fails, and counts.
//
// The blur of a photon map is a stated bias, but it has no bound: a lamp in a closed body lights
// the outside of that body through its edges, which is much beside a dark room. Blur goes to 0 as
// the number of photons grows, and errors of the light transport do not. So an alarm that repeats
// is looked at a third time with 16 times the photons. It is blur if the difference has fallen
// below kBlurFalls of what it was, and is then counted, but no failure. A radius falls to 1/4 then.
// A lasting error escapes that only where blur is more than about twice as large.
#pragma once

#include <cstdint>
#include <functional>
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

// How often a property was checked, and how often it failed.
struct Tally {
  int scenes = 0, failures = 0;
};

inline constexpr double kBlurFalls = .6;

struct RunSettings {
  int maxTries = 300;            // of shrinking by exact properties; 0: none
  int maxStatisticalTries = 60;  // of shrinking by a comparison of means
};

class SceneRun {
 public:
  explicit SceneRun(RunSettings settings) : settings_(settings) {}

  void CheckInvariances(std::uint64_t seed);
  void CompareEnergy(std::uint64_t seed);
  void CompareAgreement(std::uint64_t seed);
  // Repeats what Benjamini and Hochberg's rule rejects of all comparisons so far, with fresh seeds
  // and 16 times the samples: a failure where its p-value is then below 1e-6. To be called at the
  // end, and now and then before.
  void JudgeComparisons();

  const std::vector<Failure>& Failures() const { return failures_; }
  const std::map<std::string, Tally>& Tallies() const { return tallies_; }
  int Repeated() const { return repeated_; }
  // Of those, the alarms that more photons explained as blur.
  const std::vector<Failure>& Blurred() const { return blurred_; }
  // "invariances: 200 scenes, 0 failures; rate at most 1.5 % (95 %)", a line for each property.
  std::string Summary() const;

 private:
  using Compare = std::function<std::vector<Comparison>(const SceneModel&, const Effort&)>;
  struct Record {
    std::uint64_t seed;
    std::string property;
    Comparison comparison;
    bool isJudged = false;
  };
  void Add(const std::string& property, std::uint64_t seed);
  void Judge(Record* record);
  // The comparisons with 16 times the samples; a scene is rendered once for all that it alarms.
  std::vector<Comparison> LookAgain(const SceneModel& scene, const Record& record,
                                    int photonFactor);

  RunSettings settings_;
  std::vector<Record> records_;
  std::vector<Failure> failures_, blurred_;
  std::map<std::string, Tally> tallies_;
  std::map<int, IntegratorLook> looks_;  // by photonFactor, at lookedSeed_
  std::uint64_t lookedSeed_ = 0;
  int repeated_ = 0;
};

}  // namespace exphoton::random_scenes
