// SPDX-License-Identifier: BSD-2-Clause
// `exphoton render` and its forms that do not render: scenes in, pictures out.
#pragma once

#include "core/app/options/options.h"

namespace exphoton::cli {

// Does every scene of the command; one that fails does not keep the others from rendering. Returns
// the exit status of the first failure, 0 where there was none.
int RunRender(const RenderCommand& command);

}  // namespace exphoton::cli
