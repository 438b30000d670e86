// SPDX-License-Identifier: BSD-2-Clause
// Bump mapping: the shading normal of a surface displaced by a texture. The surface itself stays
// where it is. Source: Blinn 1978, "Simulation of Wrinkled Surfaces".
#pragma once

#include "core/scattering/texture.h"

namespace exphoton {

// Displaces along the shading normal by `displacement` (scene units) and writes the new normal and
// tangents to si->shading; the normal stays on ng's side. Differences are taken over half the pixel
// footprint in u and v, over 0.01 where there is none. Anything not finite changes nothing.
void ApplyBump(const Texture<Real>& displacement, SurfaceInteraction* si);

}  // namespace exphoton
