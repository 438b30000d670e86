// SPDX-License-Identifier: BSD-2-Clause
// The light "infinite" emits radiance from all directions, uniform or from a latitude-longitude map
// (azimuth about z from x, polar angle from +z).
#include "lights/environment/infinite_light.h"

namespace exphoton {
namespace {

const ParamTable<InfiniteLightSettings>& Parameters() { return InfiniteLightParameters(); }

std::unique_ptr<Light> Create(const InfiniteLightSettings& settings, const LightContext& context) {
  return MakeInfiniteLight(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("infinite", "light from all directions, uniform or from a map")
