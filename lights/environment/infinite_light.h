// SPDX-License-Identifier: BSD-2-Clause
// MakeInfiniteLight makes the light "infinite", whose alias is "infinitesample". In version 1 of
// the scene language, the first sampled directions uniformly and the second by the map; here both
// sample by the map.
#pragma once

#include "core/plugin.h"

namespace exphoton {

struct InfiniteLightSettings {
  Spectrum radiance{1};
  Spectrum scale{1};
  std::string mapName;
  int sampleCount = 1;
};

const ParamTable<InfiniteLightSettings>& InfiniteLightParameters();
std::unique_ptr<Light> MakeInfiniteLight(const InfiniteLightSettings& settings,
                                         const LightContext& context);

}  // namespace exphoton
