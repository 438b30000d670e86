// SPDX-License-Identifier: BSD-2-Clause
// ProbeSampling checks the sampler of a scene, and filters.
#pragma once

#include "tests/random/probes/probed_scene.h"

namespace exphoton::random_scenes {

void ProbeSampling(const ProbedScene& scene, std::uint64_t seed, Findings* findings);

}  // namespace exphoton::random_scenes
