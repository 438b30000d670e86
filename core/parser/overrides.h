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
// parameter that the plugin does not declare. `what` names the plugin in messages.
void ApplyOverrides(const std::vector<ParameterOverride>& overrides, const std::string& directive,
                    const std::string& what, const std::vector<ParamDecl>& declared,
                    ParamSet* params);

// --quick: divides the counts of an integrator, both given and default values, by the divisors that
// it declares (ParamDecl::quickDivisor). No value falls below its minimum, and none that is above 0
// falls to 0.
void ScaleForQuick(const std::vector<ParamDecl>& declared, ParamSet* params);

}  // namespace exphoton
