// SPDX-License-Identifier: BSD-2-Clause
// PluginRegistry: finds plugins by kind and name, loads each when it is first named, and makes
// objects from them. One a render; libraries stay loaded until the process ends (never dlclose).
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/plugins/descriptor.h"
#include "core/plugins/search.h"

namespace exphoton {

class PluginRegistry {
 public:
  // Folders in order of preference; each may hold <kind folder>/<name>.so or <name>.so. Of two
  // files for one plugin the first counts, even where it is broken.
  PluginRegistry(PluginFolders folders, Log* log);
  PluginRegistry(const std::vector<std::string>& chosen, Log* log)
      : PluginRegistry(ChosenFolders(chosen), log) {}

  // --plugin-dir, PBRT_SEARCHPATH and the folder beside the program, in this order.
  static std::vector<std::string> DefaultFolders(const std::vector<std::string>& extra);

  // The form of that kind of the plugin of that name (aliases resolved: "diffuse" is "area").
  // Throws Error(Scene) at `where`: missing (listing what exists and where it looked), not a
  // library, wrong ABI or build, wrong kind, another name, threw.
  const PluginFactory& Find(PluginKind kind, const std::string& name, const SourceLocation& where);

  template <PluginKind kind>
  std::unique_ptr<typename PluginTraits<kind>::Product> Create(
      const std::string& name, const ParamSet& params, BindContext bind,
      const typename PluginTraits<kind>::Context& context) {
    return std::unique_ptr<typename PluginTraits<kind>::Product>(
        static_cast<typename PluginTraits<kind>::Product*>(
            CreateErased(kind, name, params, std::move(bind), &context)));
  }

  // Sorted names of what can be loaded from the kind's folders; loads all of them.
  std::vector<std::string> Available(PluginKind kind) const;
  std::vector<std::string> Loaded() const;  // "integrators/exphotonmap", sorted
  const PluginDescriptor& Load(PluginKind kind, const std::string& name,
                               const SourceLocation& where);

 private:
  std::string PlacesText() const;
  // Null where there is no such plugin. Throws PluginFileError.
  const PluginDescriptor* TryLoad(PluginKind kind, const std::string& name) const;
  [[noreturn]] void ThrowMissing(PluginKind kind, const std::string& name,
                                 const SourceLocation& where) const;
  // Of all plugins of a kind. The first call for a kind loads them.
  const std::vector<std::string>& ParameterNames(PluginKind kind);
  void* CreateErased(PluginKind kind, const std::string& name, const ParamSet& params,
                     BindContext bind, const void* context);

  PluginFolders folders_;
  Log* log_;
  std::map<PluginKind, std::vector<std::string>> parameterNames_;  // of kinds asked for
  std::set<std::string> noticed_;                                  // aliases that were named before
  std::map<std::string, const PluginDescriptor*> loaded_;          // by "<kind folder>/<name>"
};

}  // namespace exphoton
