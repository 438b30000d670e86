// SPDX-License-Identifier: BSD-2-Clause
// PlaceRecords fills an irradiance cache before the first pixel is rendered. It visits one camera
// ray for each pixel of the full image, in a coarse-to-fine order, and adds a record where the
// records so far do not suffice. The order is fixed, so the cache depends on scene, camera,
// settings and seed alone: not on threads, tiles or the crop window.
#pragma once

#include <optional>

#include "integrators/irradiance/irradiance_estimate.h"

namespace exphoton {

struct IrradianceSettings {
  Real maxError = Real(.2);
  int maxSpecularDepth = 5, maxIndirectDepth = 3;
  int rays = 4096;  // of a record
  Real minWeight = Real(.5);
  Real minPixelSpacing = Real(2.5), maxPixelSpacing = 15;
  Real maxAngleDifference = 10;  // degrees
};

// The sides of a surface for which irradiance is needed, as unit normals on the sides from which
// light arrives. A null normal means none.
struct IrradianceSides {
  std::optional<Normal3> reflection, transmission;

  explicit IrradianceSides(const ShadingPoint& point);
};

// Without a camera the cache stays empty.
IrradianceCache PlaceRecords(const Scene& scene, const IrradianceSettings& settings,
                             const IndirectRadiance& incident, PreprocessContext& context);

}  // namespace exphoton
