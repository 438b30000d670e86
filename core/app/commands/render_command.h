// SPDX-License-Identifier: BSD-2-Clause
// RunRender implements `exphoton render` and its modes that do not render.
#pragma once

#include "core/app/options/options.h"

namespace exphoton::cli {

// Processes every scene of the command; a failure does not keep the other scenes from rendering.
// Returns the exit status of the first failure, or 0.
int RunRender(const RenderCommand& command);

}  // namespace exphoton::cli
