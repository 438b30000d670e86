// SPDX-License-Identifier: BSD-2-Clause
// RunFrames renders the frames of an animation one after the other (--frames).
#pragma once

#include "core/app/options/options.h"

namespace exphoton::cli {

// Goes on after a frame that fails, but not after a signal. Returns the exit status of the first
// frame that failed.
int RunFrames(const RenderCommand& command);

}  // namespace exphoton::cli
