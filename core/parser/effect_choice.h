// SPDX-License-Identifier: BSD-2-Clause
// ChooseEffects applies the --effects option to the features that the scene requires.
#pragma once

#include <string>

#include "core/scene/required_features.h"

namespace exphoton {

class Log;

// `choice` is "auto" (keeps `plan`), "all" (switches every effect on) or a list of changes to
// `plan` such as "caustics=off,lens=on". A list may begin with "all". Logs a warning for each
// effect that the scene needs and the list switches off. Throws Error(CommandLine).
RequiredFeatures ChooseEffects(RequiredFeatures plan, const std::string& choice, Log& log);

}  // namespace exphoton
