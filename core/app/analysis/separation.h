// SPDX-License-Identifier: BSD-2-Clause
// Separate splits the error of a setting into noise and bias by comparing independent seeds, and
// subtracts the reference's own noise. All terms use the relMSE weights w = 1 / (r^2 + 0.01).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton::study {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Measured is a value with its standard error. NaN means unknown.
struct Measured {
  double value = kUnknown, error = kUnknown;
  bool IsKnown() const { return std::isfinite(value); }
};

// Returns the mean and its standard error, which is unknown for fewer than two values.
Measured MeanOf(const std::vector<double>& values);

// Reference is a reference image r with its noise. From two independent halves a and b, r = (a + b)
// / 2 and the variance is mean(w (a - b)^2) / 4. From one picture, the variance is unknown.
struct Reference {
  Image mean;
  std::vector<float> halfDifference;  // (a - b) / 2 for R, G, B of each pixel; empty: unknown
  Measured variance;                  // mean of w ((a - b) / 2)^2
};
Reference MakeReference(Image a);
Reference MakeReference(const Image& a, const Image& b);  // throws ImageError like CompareImages

// Returns the relMSE of a black picture.
double BlackError(const Reference& reference);

// Separation holds error, noise and bias, measured from K pictures x with independent seeds. With
// s^2 the variance between the pictures,
//     relMse = mean w (x - r)^2,  variance = mean w s^2,  bias2 = relMse - variance - var(r),
// and error = relMse - var(r) = variance + bias2, the expected relMse against an exact reference.
// The standard error of relMse comes from its spread over the seeds. The others use the jackknife
// over the seeds plus the reference's share, and are unknown for fewer than three seeds. bias2 can
// be below 0. The weights come from the noisy reference, which shifts bias2 by a fraction of
// var(r), so references should have little noise (kMaxReferenceShare).
struct Separation {
  int seeds = 0;
  Measured relMse, error, variance, bias2;
  // The mean over the seeds holds R, G, B of each pixel, row by row.
  std::vector<float> mean;
};
Separation Separate(const std::vector<Image>& pictures, const Reference& reference);

// Returns the squared bias of square blocks of pixels, as a part of relMSE. It is the mean of B^2
// over blocks and colours, weighted by area, with B the mean over a block of the relative errors
// (x - r) / sqrt(r^2 + 0.01). What varies inside a block cancels, so the expected value is
// at most the one of bias2. Products of different pictures leave out their noise, and the noise of
// the reference is taken off. `blockWidth` is in pixels, and the blocks begin in the upper left
// corner. The value is unknown for fewer than two pictures, and its standard error, which is the
// jackknife's plus the reference's share, for fewer than three.
Measured SeparateBlocks(const std::vector<Image>& pictures, const Reference& reference,
                        int blockWidth);

// Errors are not compared if the reference's variance exceeds this fraction of the error.
inline constexpr double kMaxReferenceShare = .1;
// Returns the factor by which the reference's render time must grow to measure this error. At most
// 1 means that the reference is good enough.
double ReferenceShortfall(const Reference& reference, double error);

}  // namespace exphoton::study
