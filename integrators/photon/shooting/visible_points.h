// SPDX-License-Identifier: BSD-2-Clause
// VisiblePoints: a sample of the places whose light reaches the camera: what camera rays hit,
// straight or over specular surfaces, and what light from there hits next, where final gathering
// reads the maps. For aiming photons (photon_aim.h); a function of scene, camera, film size and
// seed alone.
#pragma once

#include <vector>

#include "core/imaging/film/camera.h"
#include "core/scene/scene.h"

namespace exphoton {

// About as many of each kind as rays that did not escape; `size` is that of the full image.
std::vector<Point3> VisiblePoints(const Scene& scene, const Camera& camera, Point2i size,
                                  std::uint64_t seed);

}  // namespace exphoton
