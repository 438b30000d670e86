// SPDX-License-Identifier: BSD-2-Clause
// What plugins there are and what parameters they take, from their own declarations: for
// `exphoton plugins` and for the pages in docs/reference/.
#pragma once

#include <map>
#include <string>

#include "core/plugins/registry.h"

namespace exphoton {

// Every kind with its plugins and their summaries.
std::string ListPlugins(PluginRegistry& registry);

// Summary and parameters of every plugin of that name, whatever its kind. Throws
// Error(CommandLine) where there is none.
std::string DescribePlugin(PluginRegistry& registry, const std::string& name);

// The reference in Markdown: pages by file name ("integrators.md"), one for each folder of plugins,
// and "README.md". The same plugins give the same bytes.
std::map<std::string, std::string> ReferencePages(PluginRegistry& registry);

}  // namespace exphoton
