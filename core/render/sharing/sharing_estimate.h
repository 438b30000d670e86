// SPDX-License-Identifier: BSD-2-Clause
// SharingBias is an estimate of the error that shared gathers add to a picture, from neighbouring
// pixels (sharing_bias.h) or from the pictures with and without sharing
// (core/render/passes/unshared/bias_of_sharing.h).
#pragma once

namespace exphoton {

// The squared bias of a group of passes falls as samples^-kSharingSlope in the mean. Single scenes
// have exponents of .3 to .8 (docs/decisions/0107-shares-of-fits.md).
constexpr double kSharingSlope = .6;

// The mean over the picture of squared bias / (L^2 + 0.01), the unit of relMSE. The estimate may be
// negative by chance. From neighbours it is the larger one of two, which is .56 standard errors too
// high if they are independent and there is no bias.
struct SharingBias {
  double squared = 0;
  double standardError = 0;
};

}  // namespace exphoton
