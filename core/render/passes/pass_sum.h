// SPDX-License-Identifier: BSD-2-Clause
// PassSum adds complete passes up to one picture, estimates its noise from the differences between
// groups of passes, and knows whether a target is reached. Renders and merges of shards use it, so
// that both stop after the same pass. Groups have different photons. Their camera samples are
// independent of each other, or they continue one sequence.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/imaging/film/pass_noise.h"
#include "core/render/passes/cancelling_errors.h"
#include "core/render/passes/photons/unequal_sets.h"
#include "core/render/render.h"

namespace exphoton {

enum class StopReason { Samples, TargetError, Accuracy, Bias, Price, TimeLimit, Signal };
const char* StopReasonName(StopReason reason);  // for example "target-error"

struct PassesResult {
  RenderResult render;
  StopReason reason = StopReason::Samples;  // Samples: the wanted number or maxSamples is reached
  int passes = 0;                           // complete passes
  std::int64_t samplesPerPixel = 0;
  std::optional<double> noise;           // estimated noise part of relMSE; absent with one pass
  double noiseError = 0;                 // its standard error
  std::vector<float> variances;          // of each pixel, three channels; empty with one pass
  std::optional<double> lastDiskArea{};  // of the last pass; nullopt: passes are not progressive
  std::optional<double> upperError{};    // relMSE; the upper end of its interval (AccuracyRule)
  int looks = 0;                         // at the error, with those of earlier renders
  double leastSamples = 0;               // that an accuracy needs at least, by the last look
  std::string changes{};                 // of settings, such as ", gathers shared -> not shared"
  std::vector<double> levels{};          // PassSum::Levels, for a certificate; empty without one
};

class PassSum {
 public:
  struct Limits {
    std::optional<double> targetError;  // noise part of relMSE
    std::int64_t maxSamples = 0;        // per pixel
  };
  // Groups of passes are independent of each other. Later groups share the places of the first
  // ones, which limits memory.
  static constexpr int kPlaces = 8;

  // `picture` receives the passes. It must outlive this object.
  PassSum(Film* picture, const Limits& limits)
      : picture_(picture), limits_(limits), noise_(picture->Crop(), kPlaces) {}

  // Adds a complete pass of a group. Groups are numbered from 0, and a pass belongs to the last
  // group or begins the next one.
  void Add(const Film& pass, std::int64_t samplesPerPixel, int group);

  // Adds light to the samples of a group that was added before.
  void AddLight(const Film& light, int group);

  // States that the groups continue one sequence of camera samples, whose errors partly cancel.
  // `within` is the mean over the first two groups of GroupForecast::Difference. It must be given
  // after the passes of these groups.
  void CorrectForSequence(double within, Trust trust);

  // States that all passes have the same photons, which cause this noise part of relMSE. It does
  // not show between groups.
  void SetPhotonNoise(double relative);
  // States that the groups so far have the same photons, and that each later group has its own. The
  // former then count as one group.
  void JoinGroups();
  // Takes the levels from another picture of the same passes, which must outlive this object.
  void UseLevelsOf(const PassSum& other) { noise_.UseLevelsOf(&other.noise_); }
  void UseOwnLevels() { noise_.UseLevelsOf(nullptr); }
  // Takes over the noise of another picture of the same passes, and its levels.
  void TakeNoise(const PassSum& other);

  // Returns TargetError or Samples if this rule holds.
  std::optional<StopReason> Reason() const;

  int Passes() const { return passes_; }
  int Groups() const { return groups_; }
  std::int64_t SamplesPerPixel() const { return samples_; }
  // The estimated noise part of relMSE; nullopt before the second group, and between JoinGroups and
  // the next group. Reason is based on it.
  std::optional<double> Noise() const;
  double NoiseError() const;  // its standard error; infinity before the second group
  // The part of Noise that shows between groups, and its degrees of freedom
  // (PassNoise::RelativeVarianceFreedom). Both need two groups.
  double NoiseBetweenGroups() const { return Correction() * RelativeVariance(); }
  double NoiseFreedom() const { return noise_.RelativeVarianceFreedom(); }
  // Returns r^2 of each pixel, to which noise is relative: PassNoise::Levels. Certificates divide
  // the bias by the same r, so that both are parts of one relMSE. Needs two groups.
  const std::vector<double>& Levels() const { return noise_.Levels(); }
  const PassNoise& GroupSums() const { return noise_; }
  // Returns whether another sum has passes of the same sizes in the same groups.
  bool HasSamePasses(const PassSum& other) const;
  // Writes the numbers of passes and samples, the noise and, if wanted, the variances.
  void Describe(bool needsVariances, PassesResult* result) const;

  // Save or load everything but the picture: the counts and the noise.
  void TransferCounts(ByteArchive* archive);
  void TransferNoise(ByteArchive* archive) { noise_.Transfer(archive); }

 private:
  bool HasTwoGroups() const { return groups_ > std::max(joined_, 1); }
  double RelativeVariance() const;
  // Returns the factor on the variance between groups.
  double Correction() const;

  Film* picture_;
  Limits limits_;
  PassNoise noise_;
  int passes_ = 0, groups_ = 0;
  int joined_ = 0;  // groups that count as one
  std::int64_t samples_ = 0;
  double correction_ = 1;   // factor on the noise of groups of one sequence
  UnequalSets sets_;        // of photons
  double photonNoise_ = 0;  // of photons that all passes share
  // RelativeVariance of noise_, for the passes so far. It is computed when it is needed.
  mutable std::optional<double> relativeVariance_;
};

}  // namespace exphoton
