// SPDX-License-Identifier: BSD-2-Clause
// VisiblePoints samples points whose light reaches the camera: hits of camera rays, directly or
// after specular bounces, and hits of one further bounce, where final gathering reads the maps.
// The result depends on scene, camera, film size and seed alone.
#pragma once

#include <cstdint>
#include <vector>

#include "core/imaging/film/camera.h"
#include "core/scene/scene.h"

namespace exphoton {

struct VisiblePoint {
  Point3 p;
  Normal3 n;  // unit geometric normal, on the side that the ray came from
};

inline constexpr std::uint32_t kUsualCameraRays = 1024;

// Returns about one point of each kind per ray that hits. `size`: resolution of the full image.
std::vector<VisiblePoint> VisiblePoints(const Scene& scene, const Camera& camera, Point2i size,
                                        std::uint64_t seed, std::uint32_t rays = kUsualCameraRays);

}  // namespace exphoton
