// SPDX-License-Identifier: BSD-2-Clause
// PlanSharing: the samples of a pixel must see one small part of a surface. A lens or motion makes
// them see a wide part.
#include "core/render/sharing/sharing_plan.h"

namespace exphoton {

SharingPlan PlanSharing(const SurfaceIntegrator& integrator, const Scene& scene,
                        const Camera& camera, AovSet aovs) {
  if (!integrator.SharesGathers(scene)) return {};
  const Interval shutter = camera.Shutter();
  if (camera.HasLens()) return {false, "the camera has a lens"};
  if (camera.MovesWithin(shutter)) return {false, "the camera moves"};
  if (scene.Primitives().MovesWithin(shutter)) return {false, "a shape moves"};
  if (aovs.Has(Aov::Variance)) return {false, "the variance AOV needs independent pixels"};
  return {true, "between neighbouring pixels on one surface"};
}

}  // namespace exphoton
