// SPDX-License-Identifier: BSD-2-Clause
// CompareLayers checks the light AOVs by laws of physics. If all diffuse and glossy surfaces
// reflect half as much, each AOV falls by a known factor, or by at least such a factor:
// - Light that is scattered once falls to a half: `direct` and `caustic`.
// - Light that is scattered at least twice falls to a quarter or less: `indirect`.
// - `emission` stays the same, and `specular` does not grow.
// Light that was put into a wrong AOV breaks one of these, except if both have the same law. So
// `direct` is compared with the AOV of `directlighting` as well. The AOVs sum to the picture.
//
// The laws hold for reflectances that are factors of a lobe, so some materials are replaced. Light
// of media on surfaces is `indirect` and scattered once, so media only absorb here.
#pragma once

#include <vector>

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

std::vector<Comparison> CompareLayers(const SceneModel& scene, const Effort& effort);

// Returns the scene file before the surfaces are darkened.
std::string LayersText(const SceneModel& scene, std::uint64_t seed);

}  // namespace exphoton::random_scenes
