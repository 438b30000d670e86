// SPDX-License-Identifier: BSD-2-Clause
// BiasOfSharing estimates the error that shared gathers add to a picture from the picture with and
// without them. In each pixel, the difference of the two pictures is the bias plus noise. The noise
// of two groups of passes is nearly independent, so the product of their differences has the
// squared bias as its expected value. The product sees bias of any shape, also of single pixels,
// which the products of neighbours (core/render/sharing/sharing_bias.h) do not see.
// docs/decisions/0095-bias-of-sharing-from-both-pictures.md has the derivation and measurements.
#pragma once

#include <optional>

#include "core/imaging/film/pass_noise.h"
#include "core/render/sharing/sharing_estimate.h"

namespace exphoton {

// How the camera samples of the groups depend on each other. The errors of groups that continue one
// sequence partly cancel, and the products are then too small.
enum class GroupSamples { Independent, OneSequence };

// Both arguments have the same passes in the same groups. The result is relative to the levels of
// the picture without sharing. Returns nullopt with fewer than two groups.
std::optional<SharingBias> BiasOfSharing(const PassNoise& shared, const PassNoise& unshared,
                                         GroupSamples samples);

}  // namespace exphoton
