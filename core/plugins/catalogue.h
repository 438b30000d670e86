// SPDX-License-Identifier: BSD-2-Clause
// The catalogue lists the plugins and their parameters from their declarations. `exphoton plugins`
// prints it, and the pages in docs/reference/ are generated from it.
#pragma once

#include <map>
#include <string>

#include "core/plugins/registry.h"

namespace exphoton {

// Returns every kind with its plugins and their summaries.
std::string ListPlugins(PluginRegistry& registry);

// Returns the summary and the parameters of every plugin of that name, for all kinds. Throws
// Error(CommandLine) if there is none.
std::string DescribePlugin(PluginRegistry& registry, const std::string& name);

// Returns the reference in Markdown by file name: one page for each folder of plugins
// ("integrators.md"), and "README.md". The same plugins always give the same bytes.
std::map<std::string, std::string> ReferencePages(PluginRegistry& registry);

}  // namespace exphoton
