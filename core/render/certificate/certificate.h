// SPDX-License-Identifier: BSD-2-Clause
// Certificate states the error of a picture, bias included, without a reference.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/render/certificate/block_bias.h"
#include "core/render/certificate/corrections.h"
#include "core/render/sharing/sharing_estimate.h"

namespace exphoton {

struct Certificate {
  double noise = 0;  // noise part of relMSE
  // Of the photon maps and of shared gathers, as means of blocks.
  BlockBias bias;
  // Of shared gathers, pixel by pixel. It includes what cancels inside blocks.
  std::optional<SharingBias> sharing;
  std::int64_t corrections = 0;         // corrected gather rays
  std::vector<std::string> notCovered;  // phrases
  double quantile = kQuantile95;        // the normal quantile of the interval

  // The parts of relMSE: the squared bias with the bounds of its interval, and all together.
  double Bias() const;
  double LowerBias() const;
  double UpperBias() const;
  double Error() const { return noise + Bias(); }
  // Whether the interval contains both no bias and a bias as large as the picture.
  bool SaysNothing() const;
};

// The interval that a certificate should have.
struct CertificateGoal {
  double smallest = 0;  // the bias that it should be able to certify (relMSE)
  double quantile = kQuantile95;

  // The bias should be known as well as the noise: to half of it, but no better than 1 %.
  static CertificateGoal ForNoise(double noise);
};

// Returns nullopt with fewer than two groups. `levels` has r^2 of the picture of all groups, three
// channels per pixel (PassSum::Levels), and `noise` is its noise part of relMSE. The bias is
// relative to the radiance that the corrections of each block lead to. The blocks are the finest
// ones that reach the goal.
std::optional<Certificate> Certify(const Corrections& corrections, std::span<const double> levels,
                                   double noise, const CertificateGoal& goal);

// Returns a line such as "error 2.1 % = noise 1.8 %, bias 1.0 % (0.6 to 1.4 %)".
std::string ErrorText(const Certificate& certificate);
// Returns phrases about blocks, corrections and what is not covered.
std::vector<std::string> DetailTexts(const Certificate& certificate);

}  // namespace exphoton
