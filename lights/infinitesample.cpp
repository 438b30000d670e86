// SPDX-License-Identifier: BSD-2-Clause
// The light "infinitesample" of version 1 is the light "infinite", sampled by its map.
#include "lights/environment/infinite_light.h"

namespace exphoton {
namespace {

const ParamTable<InfiniteLightSettings>& Parameters() { return InfiniteLightParameters(); }

std::unique_ptr<Light> Create(const InfiniteLightSettings& settings, const LightContext& context) {
  return MakeInfiniteLight(settings, context);
}

}  // namespace
}  // namespace exphoton

EXPHOTON_LIGHT("infinitesample", "the same light as \"infinite\", by its other name in version 1")
