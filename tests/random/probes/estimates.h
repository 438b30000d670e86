// SPDX-License-Identifier: BSD-2-Clause
// CompareEstimates compares two estimates of one number, made in different ways from the parts of a
// random scene: by rays from lights and by samples of lights, by densities and by samples. Neither
// way renders a picture.
#pragma once

#include "tests/random/scenes/agreement.h"

namespace exphoton::random_scenes {

// Returns comparisons of
// - the light in a ball by emitted rays and by samples of direct light,
// - the power of emitted rays and the power of the light,
// - integrals of the densities of light samples and of BSDF samples, and the share that succeeds,
// - the light of media along a ray by the volume integrator and by independent points.
std::vector<Comparison> CompareEstimates(const SceneModel& scene, const Effort& effort);

}  // namespace exphoton::random_scenes
