// SPDX-License-Identifier: BSD-2-Clause
// The light "infinite" emits radiance from all directions, uniform or from a latitude-longitude map
// (azimuth about z from x, polar angle from +z).
#include "lights/environment/infinite_light.h"

EXPHOTON_PLUGIN("infinite", "light from all round the scene, uniform or from a map",
                exphoton::MakeFactory<exphoton::PluginKind::Light>(
                    exphoton::InfiniteLightParameters(), exphoton::MakeInfiniteLight))
