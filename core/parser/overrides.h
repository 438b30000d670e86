// SPDX-License-Identifier: BSD-2-Clause
// What the command line changes in a scene's parameters: --set and --quick. Values are given the
// type that the plugin declares, so nobody has to write types on a command line.
#pragma once

#include "core/params/param_table.h"
#include "core/parser/render_setup.h"

namespace exphoton {

// Throws Error(CommandLine) for a --set of a directive that cannot be set.
void CheckOverrides(const std::vector<ParameterOverride>& overrides);

// Adds what --set says of that directive; a parameter that is not declared throws
// Error(CommandLine). `what` names the plugin in messages.
void ApplyOverrides(const std::vector<ParameterOverride>& overrides, const std::string& directive,
                    const std::string& what, const std::vector<ParamDecl>& declared,
                    ParamSet* params);

// --quick: divides counts of photons by 10 and of gather samples by 4, given or default.
void ScaleForQuick(const std::vector<ParamDecl>& declared, ParamSet* params);

}  // namespace exphoton
