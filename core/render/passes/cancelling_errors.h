// SPDX-License-Identifier: BSD-2-Clause
// The errors of two halves of one sequence of camera samples partly cancel, so the difference of
// the halves overstates the error of their mean. Derivation and measurements:
// docs/decisions/0046-gathers-of-several-passes.md and
// docs/decisions/0082-levels-of-noisy-pixels.md
#pragma once

#include <cmath>
#include <cstdint>

namespace exphoton {

// Halves of smaller groups of passes say little about errors that cancel: shared gathers find
// better windows in a group than in its halves, so the halves differ more.
constexpr std::int64_t kLeastOfHalves = 8;

// Returns the squared error of the mean of two halves of a sequence, divided by a quarter of their
// squared difference. Let the squared error of n samples be n^-s, and `ratio` be 2^-s. The halves
// then suggest the error 1 - ratio where it is ratio, so the result is ratio / (1 - ratio).
// Independent halves have the ratio 1/2 and the result 1. `samples` is the number per pixel in the
// group that shows the ratio. If there are few, the ratio may be too small. The result is then the
// geometric mean of the results for this ratio and for 1/2.
inline double CancellingErrors(double ratio, std::int64_t samples) {
  const double factor = ratio / (1 - ratio);
  return samples < kLeastOfHalves ? std::sqrt(factor) : factor;
}

}  // namespace exphoton
