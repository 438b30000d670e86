// SPDX-License-Identifier: BSD-2-Clause
// Separation of error into noise and bias by independent seeds, with the reference's own noise
// taken off. All terms have relMSE's weights w = 1 / (r^2 + 0.01).
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/imaging/image.h"

namespace exphoton::study {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A measurement with its standard error; NaN where it is unknown.
struct Measured {
  double value = kUnknown, error = kUnknown;
  bool IsKnown() const { return std::isfinite(value); }
};

// Mean and its standard error; the latter unknown for fewer than two values.
Measured MeanOf(const std::vector<double>& values);

// A reference r with its noise. From two independent halves a and b: r = (a + b) / 2 and its
// variance is mean(w (a - b)^2) / 4. From one picture: the variance is unknown.
struct Reference {
  Image mean;
  std::vector<float> halfDifference;  // (a - b) / 2 for R, G, B of each pixel; empty: unknown
  Measured variance;                  // mean of w ((a - b) / 2)^2
};
Reference MakeReference(Image a);
Reference MakeReference(const Image& a, const Image& b);  // throws ImageError as CompareImages

// What K pictures with independent seeds say. With s^2 the variance between them,
//     relMse = mean w (x - r)^2,  variance = mean w s^2,  bias2 = relMse - variance - var(r),
// and error = relMse - var(r) = variance + bias2, what an exact reference would show. Standard
// errors: of relMse from its spread over the seeds; of the others by the jackknife over the seeds,
// with the reference's share added; unknown for fewer than three seeds. bias2 can come out below 0.
// The weights are those of the noisy reference, which shifts bias2 by a share of var(r): a reason
// to ask for references with little noise (kMaxReferenceShare).
struct Separation {
  int seeds = 0;
  Measured relMse, error, variance, bias2;
  // The mean over the seeds, one row of R, G, B after the other.
  std::vector<float> mean;
};
Separation Separate(const std::vector<Image>& pictures, const Reference& reference);

// A ratio or a time to an error is refused where the reference's variance exceeds this share of it.
inline constexpr double kMaxReferenceShare = .1;
// By how much longer a reference must be rendered to measure this error; <= 1: it is good enough.
double ReferenceShortfall(const Reference& reference, double error);

}  // namespace exphoton::study
