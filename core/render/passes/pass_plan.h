// SPDX-License-Identifier: BSD-2-Clause
// PassPlan chooses the passes of a render with a stopping rule. Passes form groups, whose
// differences show the noise. The passes of a group have the same photons, because shooting photons
// again costs time, and groups may share them too (PhotonSets). All passes continue one sequence of
// camera samples. Derivation and measurements: docs/decisions/0037-groups-of-passes.md and
// docs/decisions/0046-gathers-of-several-passes.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/imaging/film/pass_noise.h"

namespace exphoton {

// GroupForecast predicts the noise of a group from its own passes. The noise of the photons does
// not show.
class GroupForecast {
 public:
  // sharesGathers: whether the passes of the group share their gathers together.
  GroupForecast(const PixelBounds& crop, bool sharesGathers)
      : noise_(std::in_place, crop, 2), sharesGathers_(sharesGathers) {}

  // Adds a pass. The forecast assumes that it has about as many samples as the passes before it.
  void Add(const Film& pass, std::int64_t samplesPerPixel);
  // Returns the number of samples at which the noise part of relMSE of the group is expected to
  // fall to this; nullopt before the second pass.
  std::optional<double> SamplesFor(double noise) const;
  // Returns the noise of all passes, if the last pass and the passes before it are independent;
  // 0 before the second pass.
  double Difference() const { return difference_; }
  // Returns r^2 of each pixel (PassNoise::Levels). Must be called after the second pass only.
  const std::vector<double>& Levels() const { return levels_; }
  void Release() {  // frees the memory
    noise_.reset();
    levels_ = {};
  }
  void Transfer(ByteArchive* archive);  // saves or loads

 private:
  std::optional<PassNoise> noise_;
  bool sharesGathers_;
  std::int64_t samples_ = 0;
  double difference_ = 0;
  std::vector<double> levels_;
  double slope_ = 1.5;  // the error falls as samples^-slope
};

class PassPlan {
 public:
  struct Limits {
    std::optional<double> targetError, timeLimit;  // as in StoppingRule
    std::int64_t maxSamples = 0;                   // per pixel
    std::int64_t passSamples = 0;                  // of each pass; 0: chosen by the noise
    // If positive, the first two passes are groups with this number of samples, and later ones
    // follow State::needed. A later pass is a group as well, unless its photons would cost more
    // than `photonSamples` says: the price of the photons of a group in samples per pixel. The last
    // group then takes it, but no group becomes more than twice as large as the first one, and no
    // pass is made smaller than a quarter of the samples so far for this.
    std::int64_t firstSamples = 0;
    double photonSamples = 0;
    bool sharesGathers = false;  // between pixels, for which small groups are bad
  };
  // The state of the render. Times are in seconds and used only with a time limit.
  struct State {
    std::int64_t samples = 0;        // per pixel, so far
    std::optional<double> noise;     // of the picture; known if there are two groups
    std::optional<double> enough;    // samples that two groups need to reach the target
    std::optional<double> needed{};  // samples at which an accuracy is expected
    bool keepsPhotons = false;       // later groups shoot none
    double elapsed = 0;              // since the start of the time limit
    double preprocess = 0;           // for one preprocessing
    double sample = 0;               // for one sample per pixel
  };
  explicit PassPlan(const Limits& limits) : limits_(limits) {}

  struct Step {
    bool isNewGroup = true;
    std::int64_t size = 1;  // samples per pixel; 0: no sample fits into the time limit
  };
  // Returns the next pass. The first group doubles until it has about half the samples that are
  // needed. The second one takes as many in two passes. More groups follow if the noise is still
  // too large.
  Step Next(const State& state) const;
  void Take(const Step& step);  // the pass was rendered

  // Returns the expected time until the render stops, if it is known.
  std::optional<double> SecondsLeft(const State& state) const;

  int Groups() const { return groups_; }
  std::int64_t FirstSamples() const { return firstSamples_; }  // per pixel, of the first group
  void Transfer(ByteArchive* archive);                         // saves or loads, without the limits

 private:
  std::int64_t GoalByTime(const State& state) const;
  std::int64_t FirstGoal(const State& state) const;
  std::int64_t LaterGoal(const State& state) const;
  Step NextForAccuracy(const State& state) const;

  Limits limits_;
  int groups_ = 0;
  std::int64_t groupSamples_ = 0, firstSamples_ = 0;  // of the last group and of the first one
};

}  // namespace exphoton
