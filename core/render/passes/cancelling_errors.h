// SPDX-License-Identifier: BSD-2-Clause
// The errors of two halves of one sequence of camera samples partly cancel, so the difference of
// the halves overstates the error of their mean. Derivation and measurements:
// docs/decisions/0046-gathers-of-several-passes.md and
// docs/decisions/0082-levels-of-noisy-pixels.md
#pragma once

#include <cmath>
#include <cstdint>

namespace exphoton {

// How far the difference of halves of a group is trusted. In small groups it says little. Shared
// gathers find better windows in a group than in its halves, so the halves differ more.
enum class Trust { Full, Half };
inline Trust TrustIn(std::int64_t groupSamples, bool sharesGathers) {
  return groupSamples < 8 || sharesGathers ? Trust::Half : Trust::Full;
}

// The ratio of the squared errors of n and n / 2 samples, for the difference between pictures with
// and without shared gathers. Three scenes have .45 to .54
// (docs/decisions/0095-bias-of-sharing-from-both-pictures.md).
inline constexpr double kUsualErrorRatio = .45;

// Returns the squared error of the mean of two halves of a sequence, divided by a quarter of their
// squared difference. Let the squared error of n samples be n^-s, and `ratio` be 2^-s. The halves
// then suggest the error 1 - ratio where it is ratio, so the result is ratio / (1 - ratio).
// Independent halves have the ratio 1/2 and the result 1. A ratio of half trust may be too small.
// The result is then the geometric mean of the results for this ratio and for 1/2.
inline double CancellingErrors(double ratio, Trust trust) {
  const double factor = ratio / (1 - ratio);
  return trust == Trust::Half ? std::sqrt(factor) : factor;
}

}  // namespace exphoton
