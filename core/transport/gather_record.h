// SPDX-License-Identifier: BSD-2-Clause
// GatherRecord is the diffuse part of a final gather at one vertex of a camera path. Integrators
// hand records to the renderer, which shares them between neighbouring pixels
// (core/render/sharing/shared_gathers.h) and adds their light to the picture.
#pragma once

#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"

namespace exphoton {

struct GatherRecord {
  Point3 p;
  Normal3 n, ng;    // shading and geometric normal, both on the side of the viewer; unit
  Spectrum light;   // radiance that leaves a white diffuse surface at p, estimated by the gather
  Spectrum weight;  // factor on `light` in the camera sample: reflectance times path throughput
  int depth = 0;    // specular bounces between the camera and p

  bool IsFinite() const { return light.IsFinite() && weight.IsFinite(); }
};

using GatherRecords = std::vector<GatherRecord>;

}  // namespace exphoton
