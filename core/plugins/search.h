// SPDX-License-Identifier: BSD-2-Clause
// Plugin search: finds plugin files and resolves aliases. It loads no plugins.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/plugins/kinds.h"

namespace exphoton {

// An alternative name of a plugin in scene files, or the name of a plugin of some version of pbrt
// that is not available.
struct PluginAlias {
  PluginKind kind;
  const char* alias;
  const char* name;
  const char* loss;  // what the picture loses, for a warning; null: the names are synonyms
};
const PluginAlias* FindPluginAlias(PluginKind kind, const std::string& name);
// Returns all aliases, sorted by kind.
std::span<const PluginAlias> AllPluginAliases();
// Returns a hint for the name of a plugin of some version of pbrt that has no substitute; "" for
// other names.
std::string AdviceForMissingPlugin(PluginKind kind, const std::string& name);

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
// Returns the existing files <folder>/<kind folder>/<name>.so and <folder>/<name>.so of the folders
// that are not skipped, in the order of the folders.
std::vector<PluginFile> FindPluginFiles(const PluginFolders& folders, PluginKind kind,
                                        const std::string& name);

// Returns the names of all files <folder>/<kind folder>/<name>.so in folders that are not skipped,
// sorted and without duplicates.
std::vector<std::string> PluginNamesIn(const PluginFolders& folders, PluginKind kind);

}  // namespace exphoton
