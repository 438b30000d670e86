// SPDX-License-Identifier: BSD-2-Clause
// AddParameterStrips puts the pictures of parameters onto the reference pages.
#pragma once

#include <map>
#include <string>

#include "core/plugins/registry.h"

namespace exphoton {

// Appends its strips to the section of each plugin, in the order of its table. Where another plugin
// of the page has the strip of a parameter with the same name and meaning, the section gets a link
// to that plugin instead. `pages` are the ReferencePages by file name.
void AddParameterStrips(PluginRegistry& registry, std::map<std::string, std::string>* pages);

}  // namespace exphoton
