// SPDX-License-Identifier: BSD-2-Clause
// These functions transform surface points and records from local space to world space, and rays
// and points back. They are used for instances and moving objects.
#pragma once

#include "core/geometry/interaction.h"
#include "core/math/transform.h"

namespace exphoton {

// Does not normalise the direction, so that t means the same in both spaces.
Ray RayToLocal(const Transform& toLocal, const Ray& ray, Real tMax);
SurfacePoint PointToLocal(const Transform& toLocal, const SurfacePoint& point);

// Enlarges the error bound by the rounding of rays that will be transformed back to local space.
SurfacePoint PointToWorld(const Transform& toWorld, const SurfacePoint& local);
SurfaceInteraction SurfaceToWorld(const Transform& toWorld, const SurfaceInteraction& local);

// Returns dA_world / dA_local for a surface with unit local normal ng. A local density in area
// measure is divided by this factor.
Real AreaScale(const Transform& toWorld, const Normal3& ng);
// Returns dw_local / dw_world for solid angles about the unit world direction w. A local density in
// solid angle is multiplied by this factor.
Real SolidAngleScale(const Transform& toWorld, const Vector3& w);

}  // namespace exphoton
