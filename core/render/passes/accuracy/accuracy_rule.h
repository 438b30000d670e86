// SPDX-License-Identifier: BSD-2-Clause
// AccuracyRule decides whether a picture has reached an accuracy: whether the upper end of the
// interval of its error lies below the accuracy. It looks at the picture after each group of
// passes. Look j may be wrong with the probability 5 % / (j (j + 1)), so that the chance of any
// wrong look is at most 5 %, whenever the render stops. If the picture lacks effects, a fifth of
// the 5 % belongs to their bounds, which hold together at a level of 99 %.
#pragma once

#include <algorithm>
#include <limits>

#include "core/render/certificate/certificate.h"
#include "core/render/sharing/sharing_estimate.h"

namespace exphoton {

class ByteArchive;

// What a look knows, as parts of relMSE.
struct ErrorEstimate {
  double noise = 0, noiseError = 0;          // the latter: standard error
  double fixedNoise = 0;                     // the part that more samples do not reduce
  const Certificate* certificate = nullptr;  // null: the integrator has no bias
  // The part of the noise that groups show. It spreads as a chi-square variate with this number of
  // degrees of freedom. Infinity: the noise spreads as a normal number with the standard error.
  double betweenGroups = 0, freedom = std::numeric_limits<double>::infinity();
  const Certificate* ofMaps = nullptr;  // of the photon maps alone; null: `certificate` is one
  double photonNoise = 0;               // of photons that all groups so far share
};

// Returns z with P(Z > z) = probability for a standard normal Z. probability: in (0, 0.5].
double NormalQuantile(double probability);

class AccuracyRule {
 public:
  // error: root of relMSE, > 0. biasShare: of its square, what certificates should resolve.
  // omitted: bound of the root of relMSE between the pictures with and without the effects that are
  // left out; less than `error`. It is added to the error, because it may have the bias's sign.
  AccuracyRule(double error, double biasShare, double omitted = 0)
      : wanted_(error * error),
        room_((error - omitted) * (error - omitted)),
        biasShare_(biasShare),
        omitted_(omitted) {}

  // Returns the goal of the certificate for the next look.
  CertificateGoal NextGoal() const;
  void Look(const ErrorEstimate& estimate);
  // Counts looks whose results are not used: at another picture, or at an earlier render.
  void CountLooks(int looks) { looks_ += looks; }
  int Looks() const { return looks_; }
  // Returns the upper end of the interval of this bias at the last look, as a part of relMSE.
  double MostBias(const SharingBias& sharing) const;

  // The results of the last look.
  double Upper() const { return upper_; }  // end of the interval of relMSE, with `omitted`
  bool IsReached() const { return upper_ <= wanted_; }
  // Returns whether the bias alone exceeds the accuracy.
  bool IsOutOfReach() const { return lowerBias_ > room_; }
  // Returns whether the bias of the photon maps takes too much of the room, and the picture is far
  // from done, so that it should begin again with more photons.
  bool NeedsMorePhotons() const {
    return mapBias_ > kMostMapBias * room_ && lowerMapBias_ > kSureMapBias * room_ &&
           growth_ > kFarGrowth;
  }
  // Returns the noise that the bias of the last look leaves room for, as a part of relMSE.
  double RoomForNoise() const { return std::max(room_ - bias_, 0.); }
  // Returns the factor by which the number of samples must grow, if the noise falls as 1 / samples,
  // the bias of shared gathers falls by kSharingSlope, photons that are shot again lower the fixed
  // noise, and the interval of the bias shrinks as far as certificates need it (BiasDistance). The
  // interval of the noise is the one of normal noise, because groups, rather than samples, give it
  // degrees of freedom. Returns infinity if the rest of the bias leaves no room.
  double Growth() const { return growth_; }
  // The same if the noise is one standard error lower than estimated, and the bias as low as its
  // interval allows.
  double LeastGrowth() const { return leastGrowth_; }
  // Returns whether the picture of the last look, with this number of samples, costs far more than
  // a rival for this number, even with the least growth.
  bool IsDearerThan(double rivalSamples, double samples) const {
    return samples * (leastGrowth_ - 1) > kDearer * rivalSamples;
  }

  // Returns whether there is a result. Looks at an earlier render have none.
  bool HasLooked() const { return upper_ < std::numeric_limits<double>::infinity(); }
  // Saves or loads the number of looks and the results of the last one.
  void Transfer(ByteArchive* archive);

 private:
  double WrongChance(int look) const;
  double Quantile(int look) const { return NormalQuantile(WrongChance(look)); }

  // Shares of the room, for the bias and for the lower end of its interval. Certificates do not
  // know the bias inside blocks, so the bias of blocks may not take the whole room.
  static constexpr double kMostMapBias = .25, kSureMapBias = .125;
  static constexpr double kFarGrowth = 2;  // the picture needs as many samples again, at least
  static constexpr double kDearer = 2;     // the rival's price comes from small pilots

  double wanted_, room_, biasShare_;  // relMSE; without and with omissions
  double omitted_;
  int looks_ = 0;
  double upper_ = std::numeric_limits<double>::infinity();  // before the first look
  double bias_ = 0, lowerBias_ = 0, mapBias_ = 0, lowerMapBias_ = 0;
  double growth_ = 1, leastGrowth_ = 1;
};

}  // namespace exphoton
