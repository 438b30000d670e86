// SPDX-License-Identifier: BSD-2-Clause
#include "core/render/passes/pass_sum.h"

#include <algorithm>
#include <cmath>

#include "core/files/byte_archive.h"
#include "core/imaging/metrics/metrics.h"
#include "core/render/certificate/group_places.h"

namespace exphoton {

const char* StopReasonName(StopReason reason) {
  switch (reason) {
    case StopReason::Samples:
      return "samples";
    case StopReason::TargetError:
      return "target-error";
    case StopReason::Accuracy:
      return "accuracy";
    case StopReason::Bias:
      return "bias";
    case StopReason::Price:
      return "price";
    case StopReason::TimeLimit:
      return "time-limit";
    case StopReason::Signal:
      return "signal";
  }
  return "";
}

void PassSum::Add(const Film& pass, std::int64_t samplesPerPixel, int group) {
  const int place = PlaceOfGroup(group, kPlaces, joined_ > 0);
  picture_->Add(pass);
  noise_.Add(place, pass, samplesPerPixel);
  if (sets_.AreJoined()) sets_.Add(group, place, samplesPerPixel);
  relativeVariance_.reset();
  ++passes_;
  groups_ = std::max(groups_, group + 1);
  samples_ += samplesPerPixel;
}

void PassSum::AddLight(const Film& light, int group) {
  picture_->Add(light);
  noise_.Add(group < joined_ ? 0 : PlaceOfGroup(group, kPlaces, joined_ > 0), light, 0);
  relativeVariance_.reset();
}

std::optional<double> PassSum::Noise() const {
  if (!HasTwoGroups()) return std::nullopt;
  return NoiseBetweenGroups() + photonNoise_;
}

double PassSum::RelativeVariance() const {
  if (!relativeVariance_) relativeVariance_ = noise_.RelativeVariance();
  return *relativeVariance_;
}

double PassSum::Correction() const { return correction_ * sets_.FactorOn(RelativeVariance()); }

double PassSum::NoiseError() const { return Correction() * noise_.RelativeVarianceError(); }

// Errors fall by the ratio q from the halves of a group to the group, and so do the differences of
// halves. If groups have photons of their own, the noise of photons shows between groups only. It
// raises the ratio, so the noise is overestimated then.
void PassSum::CorrectForSequence(double within, Trust trust) {
  constexpr double kLeastRatio = .35;
  correction_ = 1;
  if (groups_ > 1 && within > 0) {
    const double ratio = std::clamp(RelativeVariance() / within, kLeastRatio, .5);
    correction_ = CancellingErrors(ratio, trust);
  }
}

void PassSum::SetPhotonNoise(double relative) { photonNoise_ = relative; }

void PassSum::JoinGroups() {
  sets_.Join(groups_ > 1 ? correction_ * RelativeVariance() : 0, samples_);
  if (groups_ > 1) {
    noise_.Join();
    correction_ = 1;  // it is of groups without noise of photons between them
  }
  joined_ = groups_;
  photonNoise_ = 0;
  relativeVariance_.reset();
}

void PassSum::TakeNoise(const PassSum& other) {
  noise_ = other.noise_;
  correction_ = other.correction_;
  sets_ = other.sets_;
  relativeVariance_.reset();
}

bool PassSum::HasSamePasses(const PassSum& other) const {
  bool isSame = passes_ == other.passes_ && groups_ == other.groups_ && joined_ == other.joined_ &&
                samples_ == other.samples_;
  for (int place = 0; place < kPlaces; ++place)
    isSame = isSame && noise_.SamplesOf(place) == other.noise_.SamplesOf(place);
  return isSame;
}

std::optional<StopReason> PassSum::Reason() const {
  if (limits_.targetError && HasTwoGroups() && *Noise() <= *limits_.targetError)
    return StopReason::TargetError;
  if (samples_ >= limits_.maxSamples) return StopReason::Samples;
  return std::nullopt;
}

void PassSum::Describe(bool needsVariances, PassesResult* result) const {
  result->passes = passes_;
  result->samplesPerPixel = samples_;
  result->noise = Noise();
  result->noiseError = result->noise ? NoiseError() : 0;
  if (!needsVariances || !HasTwoGroups()) return;
  result->variances = noise_.Variances();
  const double correction = Correction();
  const std::vector<double> levels =
      photonNoise_ > 0 ? noise_.Levels() : std::vector<double>(result->variances.size());
  for (std::size_t i = 0; i < levels.size(); ++i)
    result->variances[i] = float(double(result->variances[i]) * correction +
                                 photonNoise_ * (levels[i] + kRelMseOffset));
}

void PassSum::TransferCounts(ByteArchive* archive) {
  archive->Values(&passes_, &groups_, &joined_, &samples_, &correction_, &photonNoise_);
  if (groups_ < 0 || groups_ > passes_ || samples_ < passes_ || samples_ > limits_.maxSamples ||
      !(correction_ > 0 && correction_ <= 1) || !(photonNoise_ >= 0) || joined_ < 0 ||
      joined_ > groups_)
    throw ArchiveError("its counts of passes contradict each other");
  sets_.Transfer(archive);
  relativeVariance_.reset();
}

}  // namespace exphoton
