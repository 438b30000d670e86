// SPDX-License-Identifier: BSD-2-Clause
// CheckLight checks a light against itself: its samples against their densities, its radiance
// against its samples, and the power of its photons against the light that arrives.
#pragma once

#include "core/app/checks/check.h"
#include "core/scene/scene.h"

namespace exphoton {

// `scene` has one light. An area light is on a sphere, the only shape of the scene.
Checks CheckLight(const Scene& scene, std::uint64_t seed);

}  // namespace exphoton
