// SPDX-License-Identifier: BSD-2-Clause
// Where plugins lie and what names stand for them. Loads nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/plugins/kinds.h"

namespace exphoton {

// Another name that scene files have for a plugin.
struct PluginAlias {
  PluginKind kind;
  const char* alias;
  const char* name;
  const char* notice;  // said when it is used; null: the two are the same thing
};
const PluginAlias* FindPluginAlias(PluginKind kind, const std::string& name);

// What is wrong with a name, as the rest of a sentence; nothing where it may name a plugin.
std::optional<std::string> FaultOfPluginName(const std::string& name);

// A plugin is native code that runs with the user's rights, so a folder counts by who named it.
enum class PluginTrust {
  Chosen,   // by the user: --plugin-dir, PBRT_SEARCHPATH, the program's own folders
  Allowed,  // named by a scene file, and allowed by the user (--allow-scene-plugins)
  Skipped,  // named by a scene file: not searched
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
// <folder>/<kind folder>/<name>.so or <folder>/<name>.so of the first folder that has one and is
// not skipped.
std::optional<PluginFile> FindPluginFile(const PluginFolders& folders, PluginKind kind,
                                         const std::string& name);

// Names of all files <folder>/<kind folder>/<name>.so of folders that are not skipped, sorted, each
// once.
std::vector<std::string> PluginNamesIn(const PluginFolders& folders, PluginKind kind);

}  // namespace exphoton
