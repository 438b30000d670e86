// SPDX-License-Identifier: BSD-2-Clause
// PluginRegistry finds plugins by kind and name, loads each on first use, and creates objects from
// them. There is one registry per render. Libraries stay loaded until the process ends (no
// dlclose).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/plugins/descriptor.h"
#include "core/plugins/search.h"

namespace exphoton {

class PluginRegistry {
 public:
  // `folders` is in order of preference. Each folder may hold <kind folder>/<name>.so or <name>.so.
  // If two files match a plugin, the first is used, even if it is broken; but libraries of other
  // programs are skipped. If isStrict is set, no plugin is replaced by another.
  PluginRegistry(PluginFolders folders, Log* log, bool isStrict = false);
  PluginRegistry(const std::vector<std::string>& chosen, Log* log)
      : PluginRegistry(ChosenFolders(chosen), log) {}

  void SetLog(Log* log) { log_ = log; }  // for later messages

  // Returns `extra` (--plugin-dir), PBRT_SEARCHPATH and the folders beside the program, in this
  // order. Throws Error(File) if one of `extra` is no folder.
  static std::vector<std::string> DefaultFolders(const std::vector<std::string>& extra);

  // Returns the factory of that kind and plugin name, after resolving aliases ("diffuse" is
  // "area") and replacing plugins that are not available (search.h) with a warning. Throws
  // Error(Scene) at `where` if the plugin is missing (listing the available plugins and the folders
  // searched), is not a library, has a wrong ABI, build tag, kind or name, or throws.
  const PluginFactory& Find(PluginKind kind, const std::string& name, const SourceLocation& where);

  // Returns the declared parameters of a plugin without counting it as used, or null if it cannot
  // be loaded.
  const std::vector<ParamDecl>* Declarations(PluginKind kind, const std::string& name) const;

  template <PluginKind kind>
  std::unique_ptr<typename PluginTraits<kind>::Product> Create(
      const std::string& name, const ParamSet& params, BindContext bind,
      const typename PluginTraits<kind>::Context& context) {
    return std::unique_ptr<typename PluginTraits<kind>::Product>(
        static_cast<typename PluginTraits<kind>::Product*>(
            CreateErased(kind, name, params, std::move(bind), &context)));
  }

  // Returns the sorted names of the plugins that can be loaded from the kind's folders. Loads all
  // of them.
  std::vector<std::string> Available(PluginKind kind) const;
  std::vector<std::string> Loaded() const;  // "integrators/exphotonmap", sorted
  const PluginDescriptor& Load(PluginKind kind, const std::string& name,
                               const SourceLocation& where);

 private:
  std::string PlacesText() const;
  // Returns null if there is no such plugin. Throws PluginFileError.
  const PluginDescriptor* TryLoad(PluginKind kind, const std::string& name) const;
  // Throws PluginFileError if a library of another program has the name of a missing plugin.
  void CheckForeignFiles(PluginKind kind, const std::string& name) const;
  // Returns the plugin that is used in place of a missing one. Returns null if there is none, or if
  // it is missing too.
  const PluginDescriptor* Substitute(PluginKind kind, const std::string& name,
                                     const SourceLocation& where);
  [[noreturn]] void ThrowMissing(PluginKind kind, const std::string& name,
                                 const SourceLocation& where) const;
  // Returns Available(kind). The first call for a kind loads its plugins.
  const std::vector<std::string>& KnownNames(PluginKind kind);
  // Returns the parameter names of all plugins of a kind. The first call for a kind loads them.
  const std::vector<std::string>& ParameterNames(PluginKind kind);
  void* CreateErased(PluginKind kind, const std::string& name, const ParamSet& params,
                     BindContext bind, const void* context);

  PluginFolders folders_;
  Log* log_;
  bool isStrict_;
  // They have an entry for each kind that was used so far.
  std::map<PluginKind, std::vector<std::string>> knownNames_, parameterNames_;
  // Their keys are "<kind folder>/<name>". substitutes_ has the names of the missing plugins.
  std::map<std::string, const PluginDescriptor*> loaded_, substitutes_;
};

}  // namespace exphoton
