// SPDX-License-Identifier: BSD-2-Clause
// The light "infinitesample" of version 1 is the light "infinite", sampled by its map.
#include "lights/environment/infinite_light.h"

EXPHOTON_PLUGIN("infinitesample", "the same light as \"infinite\", by its other name in version 1",
                exphoton::MakeFactory<exphoton::PluginKind::Light>(
                    exphoton::InfiniteLightParameters(), exphoton::MakeInfiniteLight))
