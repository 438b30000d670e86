// SPDX-License-Identifier: BSD-2-Clause
// PlanSharing: the samples of a pixel must see one small part of a surface. A lens or motion makes
// them see a wide part.
#include "core/render/sharing/sharing_plan.h"

namespace exphoton {

SharingPlan PlanSharing(const SurfaceIntegrator& integrator, const Scene& scene,
                        const Camera& camera) {
  if (!integrator.SharesGathers(scene)) return {};
  const auto& features = scene.Features();
  if (features.Needs(Feature::Lens) && camera.HasLens()) return {false, "the camera has a lens"};
  const Interval shutter = camera.Shutter();
  const bool hasMotion = features.Needs(Feature::Motion);
  if (hasMotion && camera.MovesWithin(shutter)) return {false, "the camera moves"};
  if (hasMotion && scene.Primitives().MovesWithin(shutter)) return {false, "a shape moves"};
  return {true, "between neighbouring pixels on one surface"};
}

}  // namespace exphoton
