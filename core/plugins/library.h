// SPDX-License-Identifier: BSD-2-Clause
// One plugin file: loading it and checking what it says of itself. Where plugins are looked for is
// the registry's matter.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/plugins/descriptor.h"
#include "core/plugins/search.h"

namespace exphoton {

// Why a file is no plugin, as the rest of a sentence that begins with the file's path.
class PluginFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Checks the file, loads it, and checks its descriptor against this core and the name it must have.
// Code of a file that is no plugin never runs. It stays loaded until the process ends: objects and
// exceptions of its types may outlive everything else. A file of a folder that a scene names must
// belong to the user or to root, and others must not be able to change it.
const PluginDescriptor& LoadPluginFile(const PluginFile& file, const std::string& name);

// The plugins that are linked into the program (RegisterStaticPlugin), in no particular order.
const std::vector<PluginEntry>& StaticPlugins();

// What a plugin's entry says; throws PluginFileError where it does not fit this core.
const PluginDescriptor& CheckedDescriptor(PluginEntry entry, const std::string& name);

// The file that holds the code of the core: the core's library, or the program.
std::string CoreFile();

}  // namespace exphoton
