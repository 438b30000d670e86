// SPDX-License-Identifier: BSD-2-Clause
// These functions return the options of a scene with one cause of error moved towards its limit.
#pragma once

#include "core/parser/render_setup.h"

namespace exphoton::cli {

inline constexpr int kRayFactor = 4;  // of the gather rays

// Returns a parameter that the scene or the command line gives to the integrator, or its default.
double IntegratorNumber(const RenderSetup& setup, const std::string& name, double byDefault);

// `setup` is the scene with the options, before the change.
LoadOptions WithMoreRays(LoadOptions options, const RenderSetup& setup);
LoadOptions WithoutSharing(LoadOptions options);
LoadOptions WithCausticPhotons(LoadOptions options, double photons);
LoadOptions WithDeepPaths(LoadOptions options, const RenderSetup& setup);
LoadOptions WithAllEffects(LoadOptions options);
// Returns the options of guidedpath, without parameters that the command line gives to another
// integrator.
LoadOptions OfReference(LoadOptions options);

}  // namespace exphoton::cli
