// SPDX-License-Identifier: BSD-2-Clause
// LanguagePage writes the page of the reference that lists the plugins and parameters of pbrt,
// versions 1 and 2, and says for each whether it is available, replaced or ignored.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/plugins/registry.h"

namespace exphoton {

// A plugin of pbrt. The data is in pbrt_parameters.txt.
struct PbrtPlugin {
  struct Parameter {
    std::string name;
    std::string versions;  // "12", "1" or "2"
  };
  std::string versions, kind, name;
  std::vector<Parameter> parameters;
};
const std::vector<PbrtPlugin>& PbrtPlugins();

// Returns the page in Markdown.
std::string LanguagePage(PluginRegistry& registry);

// Returns ReferencePages with this page, and with the pictures of AddParameterStrips.
std::map<std::string, std::string> AllReferencePages(PluginRegistry& registry);

}  // namespace exphoton
