// SPDX-License-Identifier: BSD-2-Clause
// AccuracyRule decides whether a picture has reached an accuracy: whether the upper end of the
// interval of its error lies below the accuracy. It looks at the picture after each group of
// passes. Look j may be wrong with the probability 5 % / (j (j + 1)), so that the chance of any
// wrong look is at most 5 %, whenever the render stops.
#pragma once

#include "core/render/certificate/certificate.h"

namespace exphoton {

// What a look knows, as parts of relMSE.
struct ErrorEstimate {
  double noise = 0, noiseError = 0;          // the latter: standard error
  const Certificate* certificate = nullptr;  // null: the integrator has no bias
};

class AccuracyRule {
 public:
  // error: root of relMSE, > 0. biasShare: of its square, what certificates should resolve.
  AccuracyRule(double error, double biasShare) : wanted_(error * error), biasShare_(biasShare) {}

  // Returns the goal of the certificate for the next look.
  CertificateGoal NextGoal() const;
  void Look(const ErrorEstimate& estimate);

  // The results of the last look.
  double Upper() const { return upper_; }  // end of the interval of relMSE
  bool IsReached() const { return looks_ > 0 && upper_ <= wanted_; }
  // Returns whether the bias alone exceeds the accuracy.
  bool IsOutOfReach() const { return lowerBias_ > wanted_; }
  // Returns the factor by which the number of samples must grow, if noise and the width of the
  // interval fall as 1 / samples. Returns infinity if the bias leaves no room for noise.
  double Growth() const { return growth_; }

 private:
  double wanted_, biasShare_;  // the former: relMSE
  int looks_ = 0;
  double upper_ = 0, lowerBias_ = 0, growth_ = 1;
};

// Returns z with P(Z > z) = probability for a standard normal Z. probability: in (0, 0.5].
double NormalQuantile(double probability);

}  // namespace exphoton
