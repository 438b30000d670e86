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

// <folder>/<kind folder>/<name>.so or <folder>/<name>.so of the first folder that has one.
std::optional<std::string> FindPluginFile(const std::vector<std::string>& folders,
                                          PluginKind kind, const std::string& name);

// Names of all files <folder>/<kind folder>/<name>.so, sorted, each once.
std::vector<std::string> PluginNamesIn(const std::vector<std::string>& folders, PluginKind kind);

}  // namespace exphoton
