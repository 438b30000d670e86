// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "core/transport/shading_point.h"
#include "integrators/photon/maps/photon.h"
#include "integrators/photon/maps/rest_pose.h"

namespace exphoton {

// Returns what a radiance photon at a stored photon needs of the surface. `rest` is the pose of the
// surface.
RadiancePhotonSite RadianceSiteAt(const ShadingPoint& point, const RestPose& rest);

}  // namespace exphoton
