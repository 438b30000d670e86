// SPDX-License-Identifier: BSD-2-Clause
// ApplyBump implements bump mapping: the shading normal is the normal of a surface displaced by a
// texture. The surface itself is not moved. Source: Blinn 1978, "Simulation of Wrinkled Surfaces".
#pragma once

#include "core/scattering/texture.h"

namespace exphoton {

// Displaces along the shading normal by `displacement` (scene units) and writes the new normal and
// tangents to si->shading. The normal stays on ng's side. Differences are taken over half the pixel
// footprint in u and v, or over 0.01 without a footprint. If a result is not finite, nothing
// changes.
void ApplyBump(const Texture<Real>& displacement, SurfaceInteraction* si);

}  // namespace exphoton
