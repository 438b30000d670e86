// SPDX-License-Identifier: BSD-2-Clause
// This file checks the outputs of a run before it renders, so that no render is lost because a file
// cannot be written.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/app/options/options.h"
#include "core/app/output/run_files.h"
#include "core/parser/syntax/source.h"

namespace exphoton::cli {

// With several scene files, the output names are known only after reading all of them. This
// function reads them without loading plugins. Errors in a file are reported later, when it is
// loaded. Throws Error for names that conflict.
void CheckAllOutputs(const RenderCommand& command, RunFiles* files, FileSource::Streams* streams,
                     Log& log);

// Checks the outputs of the pictures of one scene file, and that its integrator provides them.
// `index` is the position of the file on the command line. Throws Error.
void CheckOutputs(const RenderCommand& command,
                  const std::vector<std::unique_ptr<RenderSetup>>& setups, std::size_t index,
                  RunFiles* files, Log& log);

}  // namespace exphoton::cli
