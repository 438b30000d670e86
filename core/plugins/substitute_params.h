// SPDX-License-Identifier: BSD-2-Clause
// ParamsOfSubstitute converts the parameters of a plugin that is not available to parameters of the
// plugin that is used in its place (search.h).
#pragma once

#include <string>
#include <vector>

#include "core/params/param_table.h"
#include "core/plugins/kinds.h"

namespace exphoton {

// Returns the parameters for the substitute of this plugin. Parameters that are not converted stay,
// and the substitute reports those that it does not know. Throws Error(Scene).
//
// The material "subsurface" gets the Kd that its medium reflects.
ParamSet ParamsOfSubstitute(PluginKind kind, const std::string& name, const ParamSet& params,
                            const BindContext& bind);

// Returns the parameters that ParamsOfSubstitute converts, for the pages; null if there are none.
const std::vector<ParamDecl>* ConvertedParameters(PluginKind kind, const std::string& name);

}  // namespace exphoton
