// SPDX-License-Identifier: BSD-2-Clause
// Plugin search: finds plugin files and resolves aliases. It loads no plugins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plugins/kinds.h"

namespace exphoton {

// An alternative name of a plugin in scene files.
struct PluginAlias {
  PluginKind kind;
  const char* alias;
  const char* name;
  const char* notice;  // logged on use; null: the names are synonyms
};
const PluginAlias* FindPluginAlias(PluginKind kind, const std::string& name);

// Returns the error in a plugin name, as the rest of a sentence; nullopt if the name is valid.
std::optional<std::string> FaultOfPluginName(const std::string& name);

// Plugins are native code with the user's rights, so the trust in a folder depends on its origin.
enum class PluginTrust {
  Chosen,   // chosen by the user: --plugin-dir, PBRT_SEARCHPATH, the program's folders
  Allowed,  // named by a scene file and allowed by the user (--allow-scene-plugins)
  Skipped,  // named by a scene file; not searched
};
struct PluginFolder {
  std::string path;
  PluginTrust trust = PluginTrust::Chosen;
};
using PluginFolders = std::vector<PluginFolder>;

PluginFolders ChosenFolders(const std::vector<std::string>& paths);

struct PluginFile {
  std::string path;
  PluginTrust trust;
};
// Returns <folder>/<kind folder>/<name>.so or <folder>/<name>.so from the first folder that has
// either and is not skipped.
std::optional<PluginFile> FindPluginFile(const PluginFolders& folders, PluginKind kind,
                                         const std::string& name);

// Returns the names of all files <folder>/<kind folder>/<name>.so in folders that are not skipped,
// sorted and without duplicates.
std::vector<std::string> PluginNamesIn(const PluginFolders& folders, PluginKind kind);

}  // namespace exphoton
