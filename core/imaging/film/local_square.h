// SPDX-License-Identifier: BSD-2-Clause
// SquaredLevels estimates the squared radiance of each pixel of a noisy picture, for errors that
// are relative to it. Derivation and measurements: docs/decisions/0082-levels-of-noisy-pixels.md,
// docs/decisions/0101-levels-without-own-noise.md and
// docs/decisions/0102-levels-of-confirmed-pixels.md.
#pragma once

#include <cstddef>
#include <vector>

namespace exphoton {

// Returns r^2 for each channel of each pixel, three channels per pixel, so that 1 / (r^2 + .01) has
// no bias to first order in the variances. `means` is the picture, at least 0, and `variances` has
// the estimated variance of each of its values. r is the value, drawn to the mean of the other
// values of its kind: the neighbours within 5 x 5 pixels that differ from it by no more than three
// standard deviations. The more noise the value has, and the less the true values of the kind
// differ, the closer r is to this mean (empirical Bayes, James and Stein 1961). Where r is the mean
// of others, it does not depend on the error of the variance.
//
// A lower bound of the value replaces r where it is higher than r by more than two standard
// deviations of the others: the value minus `deviations` of its own standard deviations, with one
// number for each pixel. Without these numbers, it is one standard deviation. Light that only one
// of the groups of samples has seen must not pass this bound. With groups of equal weight, such
// light is exactly one standard deviation.
std::vector<double> SquaredLevels(const std::vector<float>& means,
                                  const std::vector<float>& variances, std::size_t width,
                                  const std::vector<float>& deviations = {});

}  // namespace exphoton
