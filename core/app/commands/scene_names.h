// SPDX-License-Identifier: BSD-2-Clause
// CheckScenesExist checks the names of scenes before anything is rendered. ResumeText says how to
// continue with a scene.
#pragma once

#include "core/app/options/options.h"

namespace exphoton::cli {

class StateKeeper;

// A word that is no file may be a mistyped command, so nothing is rendered before all are readable.
// Throws Error(File) for a scene that cannot be read.
void CheckScenesExist(const RenderCommand& command);

// Throws Error(CommandLine) if the file with this index holds several scenes and an option allows
// one.
void CheckSceneCount(const RenderCommand& command, std::size_t index, std::size_t scenes);

// Returns a message that says how to continue a command that was stopped in this scene: with the
// frames and scenes that remain, because the command would render the others again. There must be a
// state.
std::string ResumeText(const RenderCommand& command, const std::string& scene,
                       const StateKeeper& state);

}  // namespace exphoton::cli
