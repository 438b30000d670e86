// SPDX-License-Identifier: BSD-2-Clause
// WritePart renders one shard of a picture into its file.
#pragma once

#include <functional>
#include <string>

#include "core/app/identity/state_identity.h"
#include "core/app/options/options.h"
#include "core/render/render.h"

namespace exphoton::cli {

struct PartJob {
  const RenderCommand& command;
  const RenderSetup& setup;
  const RenderJob& job;
  RenderOptions options;
  const StateIdentity& identity;
  std::string path;  // of the part
  Log& log;
};

// Returns false if there was nothing to render, because the part exists, or if the render was
// stopped, which leaves no file. `mustFinish` is called before the file is completed. Throws Error
// if a file of the part's name exists and is not this part, unless it is a damaged part.
bool WritePart(const PartJob& part, const std::function<void()>& mustFinish);

}  // namespace exphoton::cli
