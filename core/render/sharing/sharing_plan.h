// SPDX-License-Identifier: BSD-2-Clause
// SharingPlan decides whether a picture shares its gathers, and why. The decision depends on the
// scene itself and not on --effects, so that switching an effect on never changes the picture.
#pragma once

#include <string>

#include "core/imaging/film/aovs.h"
#include "core/imaging/film/camera.h"
#include "core/scene/scene.h"
#include "core/transport/integrator.h"

namespace exphoton {

struct SharingPlan {
  bool isOn = false;
  std::string reason;  // for example "the camera has a lens"; empty if not requested
};

SharingPlan PlanSharing(const SurfaceIntegrator& integrator, const Scene& scene,
                        const Camera& camera, AovSet aovs);

}  // namespace exphoton
