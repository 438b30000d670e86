// SPDX-License-Identifier: BSD-2-Clause
// UnseenByPaths names the light that paths from the camera never find. A path meets a light by
// chance after a mirror or glass, and only a light that has a size can be met.
#pragma once

#include <string>
#include <vector>

namespace exphoton {

class Scene;

// Returns phrases as SurfaceIntegrator::UnseenLight does. Lights that provably make no caustics do
// not count (CausticLights).
std::vector<std::string> UnseenByPaths(const Scene& scene);

}  // namespace exphoton
