// SPDX-License-Identifier: BSD-2-Clause
// MakeBudget splits the error of a picture (relMSE) by cause, from renders with several seeds. The
// parts of the noise are variances, and add up. A part of the bias is the mean over blocks of
// pixels of b_i * (sum of all b), where b_i is the signed bias by its cause, so these parts add up
// to the squared bias. Derivation: docs/decisions/0058-error-budget.md.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/app/budget/pair_products.h"

namespace exphoton::cli {

enum class ErrorCause {
  CameraSampling,    // noise of camera rays and of the light samples at visible points
  GatherDirections,  // noise
  PhotonNoise,       // noise that pictures with the same photons have in common
  Blur,              // bias of the radiance that gather rays read
  CausticKernel,     // bias of the caustic map
  Sharing,           // bias of gathers that pixels share
  DepthLimits,       // bias
  SkippedEffects,    // bias
};
inline constexpr int kErrorCauseCount = 8;
const char* ErrorCauseName(ErrorCause cause);  // "camera sampling"

// The renders of one seed, three channels per pixel.
struct SeedErrors {
  std::array<PictureValues, 2> pictures;  // same photons, other samples
  // The same with more gather rays; empty: there are none.
  std::array<PictureValues, 2> withMoreRays;
  std::vector<PictureValues> biases;  // of each cause in BudgetFrame::biasCauses
};

// What the renders of all seeds have in common.
struct BudgetFrame {
  int width = 0;               // of the pictures
  std::vector<double> levels;  // r^2 of each value: errors count relative to sqrt(r^2 + 0.01)
  double rayFactor = 1;        // of SeedErrors::withMoreRays
  std::vector<ErrorCause> biasCauses;
};

struct ErrorPart {
  ErrorCause cause = ErrorCause::CameraSampling;
  study::Measured share;    // part of relMSE; a bias that reduces another one has a negative part
  study::Measured squared;  // of a bias: mean of b_i^2 over the blocks
};

struct ErrorBudget {
  std::vector<ErrorPart> parts;  // in the order of ErrorCause; only of causes that occur
  study::Measured noise, bias;   // the sums of the parts of each kind
  study::Measured sum;           // of all parts
  int blockWidth = 0;            // of the biases, in pixels
};

// Needs at least two seeds. A block width of 0 means the finest blocks, up to 16 pixels, in which
// the standard error of the squared bias is at most a tenth of the error; or else those with the
// smallest standard error.
ErrorBudget MakeBudget(const std::vector<SeedErrors>& seeds, const BudgetFrame& frame,
                       int blockWidth);

// The error that pictures with independent seeds have against a reference of two independent
// halves.
struct MeasuredError {
  study::Measured noise;
  study::Measured bias;          // squared, in blocks
  study::Measured sum;           // of both
  study::Measured insideBlocks;  // squared bias of pixels minus `bias`
};
MeasuredError MeasureError(const std::vector<PictureValues>& pictures,
                           const std::array<PictureValues, 2>& reference, const BudgetFrame& frame,
                           int blockWidth);

// Returns the noise of pictures with independent seeds, as a part of relMSE.
study::Measured NoiseBetween(const std::vector<PictureValues>& pictures, const BudgetFrame& frame);

// Returns the factor on the bias of a part that halves the part, in (0, 1). The other biases stay.
// Returns 0 if no factor does: the part is not positive.
double HalvingFactor(const ErrorPart& part);

}  // namespace exphoton::cli
