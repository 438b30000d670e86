// SPDX-License-Identifier: BSD-2-Clause
// Surface points and records on their way from the space that a thing was made in to the world, and
// rays and points on the way back. Used for instances and for what moves.
#pragma once

#include "core/geometry/interaction.h"
#include "core/math/transform.h"

namespace exphoton {

// The direction is not normalised, so that t means the same in both spaces.
Ray RayToLocal(const Transform& toLocal, const Ray& ray, Real tMax);
SurfacePoint PointToLocal(const Transform& toLocal, const SurfacePoint& point);

// Errors grow by one rounding, that of rays which will enter the space again.
SurfacePoint PointToWorld(const Transform& toWorld, const SurfacePoint& local);
SurfaceInteraction SurfaceToWorld(const Transform& toWorld, const SurfaceInteraction& local);

// Densities change by what a map does to measures. Of the area of a surface with unit local normal
// ng: dA_world / dA_local.
Real AreaScale(const Transform& toWorld, const Normal3& ng);
// Of directions round the unit world direction w: dw_local / dw_world.
Real SolidAngleScale(const Transform& toWorld, const Vector3& w);

}  // namespace exphoton
