// SPDX-License-Identifier: BSD-2-Clause
// --effects: what the user changes in the plan that the scene gave.
#pragma once

#include <string>

#include "core/scene/required_features.h"

namespace exphoton {

class Log;

// "auto": the plan; "all": everything on; or a list "caustics=off,lens=on" over the plan. Switching
// off what the scene needs warns. Throws Error(CommandLine).
RequiredFeatures ChooseEffects(RequiredFeatures plan, const std::string& choice, Log& log);

}  // namespace exphoton
