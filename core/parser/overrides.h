// SPDX-License-Identifier: BSD-2-Clause
// These functions change a scene's parameters as the options --set and --quick request. Each --set
// value gets the type that the plugin declares, so the user does not write types.
#pragma once

#include "core/params/param_table.h"
#include "core/parser/render_setup.h"

namespace exphoton {

// Throws Error(CommandLine) if a --set names a directive that --set cannot change.
void CheckOverrides(const std::vector<ParameterOverride>& overrides);

// Adds the --set parameters for this directive to `params`. Throws Error(CommandLine) for a
// parameter that the plugin does not declare, and Error(Scene) on the command line for one that an
// earlier version of the plugin had. `what` names the plugin in messages.
void ApplyOverrides(const std::vector<ParameterOverride>& overrides, const std::string& directive,
                    const std::string& what, const ParamTableBase& table, ParamSet* params);

// Returns whether a plugin declares the parameter.
bool Declares(const std::vector<ParamDecl>& declared, const std::string& parameter);

// Returns whether two plugins mean the same by a parameter: they declare it with the same name,
// type, unit and meaning. "maxdepth" of "path" counts all bounces, and for "whitted" specular
// ones.
bool MeansTheSame(const ParamDecl& a, const ParamDecl& b);

// --integrator: removes the parameters that the file gave to its integrator, if the new one
// declares them with another meaning. `from` is null if the file's integrator cannot be loaded.
// Parameters that the new integrator does not declare stay. `log` receives a notice for each
// parameter.
struct IntegratorChange {
  std::string fromName, toName;
  const std::vector<ParamDecl>* from;
  const std::vector<ParamDecl>& to;
};
void KeepSharedParameters(const IntegratorChange& change, Log& log, ParamSet* params);

// --integrator: adds the defaults that hold where the command line names the integrator.
void AddNamedDefaults(const std::vector<ParamDecl>& declared, ParamSet* params);

// --quick: divides the counts of an integrator, both given and default values, by the divisors that
// it declares (ParamDecl::quickDivisor). No value falls below its minimum, and none that is above 0
// falls to 0.
void ScaleForQuick(const std::vector<ParamDecl>& declared, ParamSet* params);

// --frames: moves the exposure of a camera by `offset`. Throws Error(CommandLine) if the camera
// declares no shutteropen or shutterclose. `what` names the camera in messages.
void ShiftExposure(const std::vector<ParamDecl>& declared, const std::string& what, Real offset,
                   ParamSet* params);

}  // namespace exphoton
