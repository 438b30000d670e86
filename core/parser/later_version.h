// SPDX-License-Identifier: BSD-2-Clause
// RefuseLaterVersion recognises scenes of versions 3 and 4 of the scene language by their first
// directives, so that one error says what is wrong with the file.
#pragma once

#include <string>
#include <string_view>

#include "core/parser/render_setup.h"

namespace exphoton {

// Throws Error(Scene) if the file has a directive or a film that only later versions know. A file
// with errors of syntax is read up to the first one. Included files are not read.
void RefuseLaterVersion(SceneSource& source, const std::string& path, const LoadOptions& options);

// Returns whether only version 4 has this directive, or this plugin of the directive.
bool IsOfVersion4(std::string_view directive, std::string_view name);

}  // namespace exphoton
