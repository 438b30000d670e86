// SPDX-License-Identifier: BSD-2-Clause
// CheckScenesExist checks the names of scenes before anything is rendered.
#pragma once

#include "core/app/options/options.h"

namespace exphoton::cli {

// A word that is no file may be a mistyped command, so nothing is rendered before all are readable.
// Throws Error(File) for a scene that cannot be read.
void CheckScenesExist(const RenderCommand& command);

// Throws Error(CommandLine) if the file with this index holds several scenes and an option allows
// one.
void CheckSceneCount(const RenderCommand& command, std::size_t index, std::size_t scenes);

}  // namespace exphoton::cli
