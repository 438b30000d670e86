// SPDX-License-Identifier: BSD-2-Clause
// RecogniseDialect finds out which version of the scene language a file uses, before its first
// directive takes effect.
#pragma once

#include <string>

#include "core/parser/render_setup.h"

namespace exphoton {

// Returns V2 if the file or a file that it includes has a directive that only version 2 knows:
// Renderer, MakeNamedMaterial, AreaLightSource "diffuse", or a Texture of type "spectrum". A notice
// names this directive. A file with syntax errors is searched up to the first error. Throws
// LoadingStopped if options.stop is set.
Dialect RecogniseDialect(SceneSource& source, const std::string& path, const LoadOptions& options,
                         Log& log);

}  // namespace exphoton
