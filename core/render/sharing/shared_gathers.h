// SPDX-License-Identifier: BSD-2-Clause
// SharedGathers adds diffuse indirect light to a picture after all its pixels are rendered.
// Neighbouring pixels on one surface gather nearly the same light, so each camera sample takes its
// light from a local fit to the gathers around it. Window sizes are chosen by cross-validation
// (sharing_windows.h). docs/decisions/0033-shared-gathers.md has the measurements.
#pragma once

#include "core/base/parallel.h"
#include "core/imaging/film/aov_film.h"
#include "core/imaging/film/film.h"
#include "core/render/sharing/gather_fragments.h"
#include "core/render/splat_buffer.h"

namespace exphoton {

// The light of a pixel depends on the gathers within this number of pixels.
int SharingMargin();

// Adds the light of all gathers to the film and, if not null, to the AOVs. If `splats` is not null,
// it receives the light instead. Returns the mean radius of the windows in pixels.
struct SharedLightTarget {
  Film* film;
  AovFilm* aovs;
  SplatBuffer* splats;
};
double AddSharedLight(const GatherFragments& gathers, ThreadPool* threads,
                      const SharedLightTarget& target);

}  // namespace exphoton
