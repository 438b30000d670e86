// SPDX-License-Identifier: BSD-2-Clause
// Loads one plugin file and checks its descriptor. PluginRegistry finds the files.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/plugins/descriptor.h"
#include "core/plugins/search.h"

namespace exphoton {

// The reason why a file is not a usable plugin. The text continues a sentence that begins with the
// file's path.
class PluginFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The file is a library of another program, such as a plugin of pbrt-v1.
class ForeignLibraryError : public PluginFileError {
 public:
  using PluginFileError::PluginFileError;
};

// Checks the file, loads it, and checks its descriptor against this core and the expected name. The
// code of a file that is not a plugin never runs. The library stays loaded until the process ends,
// because objects and exceptions of its types may outlive everything else. If a scene names the
// folder, the file must belong to the user or to root, and other users must not be able to change
// it.
const PluginDescriptor& LoadPluginFile(const PluginFile& file, const std::string& name);

// Returns the plugins that are linked into the program (RegisterStaticPlugin), in no particular
// order.
const std::vector<PluginEntry>& StaticPlugins();

// Returns the descriptor from a plugin's entry function. Throws PluginFileError if it does not
// match this core.
const PluginDescriptor& CheckedDescriptor(PluginEntry entry, const std::string& name);

// Returns the file that contains the code of the core: the core's library, or the program.
std::string CoreFile();

}  // namespace exphoton
