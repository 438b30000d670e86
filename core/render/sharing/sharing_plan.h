// SPDX-License-Identifier: BSD-2-Clause
// SharingPlan decides whether a picture shares its gathers, and why. An effect that the scene does
// not require never changes the decision, so switching all effects on does not change the picture.
// A scene without motion, or with motion switched off, shares.
#pragma once

#include <string>

#include "core/imaging/film/camera.h"
#include "core/scene/scene.h"
#include "core/transport/integrator.h"

namespace exphoton {

struct SharingPlan {
  bool isOn = false;
  std::string reason;  // for example "the camera has a lens"; empty if not requested
};

SharingPlan PlanSharing(const SurfaceIntegrator& integrator, const Scene& scene,
                        const Camera& camera);

}  // namespace exphoton
