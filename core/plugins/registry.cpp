// SPDX-License-Identifier: BSD-2-Clause
// PluginRegistry: from a kind and a name in a scene file to a loaded plugin and an object.
#include "core/plugins/registry.h"

#include <algorithm>
#include <new>
#include <optional>

#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/plugins/library.h"
#include "core/plugins/search.h"
#include "core/plugins/substitute_params.h"

namespace exphoton {
namespace {

std::string Key(PluginKind kind, const std::string& name) {
  return std::string(PluginKindFolder(kind)) + '/' + name;
}

std::string Named(PluginKind kind, const std::string& name) {
  return std::string(PluginKindName(kind)) + " \"" + name + '"';
}

std::string Join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

const PluginFactory* FactoryOf(const PluginDescriptor& plugin, PluginKind kind) {
  for (const PluginFactory& factory : plugin.factories) {
    if (factory.kind == kind) return &factory;
  }
  return nullptr;
}

const PluginDescriptor* FindStatic(PluginKind kind, const std::string& name) {
  for (const PluginEntry entry : StaticPlugins()) {
    const PluginDescriptor& plugin = *entry();
    if (plugin.name == name && FactoryOf(plugin, kind)) return &plugin;
  }
  return nullptr;
}

}  // namespace

PluginRegistry::PluginRegistry(PluginFolders folders, Log* log, bool isStrict)
    : log_(log), isStrict_(isStrict) {
  for (PluginFolder& folder : folders) {
    const bool isKnown =
        std::any_of(folders_.begin(), folders_.end(),
                    [&](const PluginFolder& other) { return other.path == folder.path; });
    if (!isKnown) folders_.push_back(std::move(folder));
  }
}

const PluginDescriptor* PluginRegistry::TryLoad(PluginKind kind, const std::string& name) const {
  const auto found = loaded_.find(Key(kind, name));
  if (found != loaded_.end()) return found->second;
  if (const PluginDescriptor* plugin = FindStatic(kind, name)) return plugin;
  for (const PluginFile& file : FindPluginFiles(folders_, kind, name)) {
    try {
      return &LoadPluginFile(file, name);
    } catch (const ForeignLibraryError& error) {
      if (log_) log_->Notice("the file \"" + file.path + "\" is skipped: it " + error.what());
    } catch (const PluginFileError& error) {
      throw PluginFileError('"' + file.path + "\" " + error.what());
    }
  }
  return nullptr;
}

void PluginRegistry::CheckForeignFiles(PluginKind kind, const std::string& name) const {
  for (const PluginFile& file : FindPluginFiles(folders_, kind, name)) {
    try {
      LoadPluginFile(file, name);
    } catch (const PluginFileError& error) {
      throw PluginFileError('"' + file.path + "\" " + error.what());
    }
  }
}

const PluginDescriptor* PluginRegistry::Substitute(PluginKind kind, const std::string& name,
                                                   const SourceLocation& where) {
  const PluginAlias* alias = FindPluginAlias(kind, name);
  if (alias && !alias->loss) return &Load(kind, alias->name, where);
  // pbrt-v1 renders a shape with an unknown material as matte.
  if (isStrict_ || (!alias && kind != PluginKind::Material)) return nullptr;
  const std::string by = alias ? alias->name : "matte";
  const PluginDescriptor* const plugin = TryLoad(kind, by);
  if (!plugin) return nullptr;
  loaded_.emplace(Key(kind, by), plugin);
  substitutes_.emplace(Key(kind, name), plugin);
  if (log_)
    log_->Warning("there is no " + Named(kind, name) + ": \"" + by + "\" is used instead" +
                      (alias ? std::string("; ") + alias->loss : std::string()),
                  where, alias ? "" : DidYouMean(name, KnownNames(kind)));
  return plugin;
}

std::string PluginRegistry::PlacesText() const {
  std::vector<std::string> searched, skipped;
  for (const auto& [path, trust] : folders_)
    (trust == PluginTrust::Skipped ? skipped : searched).push_back(path);
  std::string text;
  if (StaticPlugins().empty()) text = "looked in " + Join(searched);
  if (!skipped.empty())
    text += (text.empty() ? "" : "; ") + ("did not look in " + Join(skipped)) +
            ", named by the scene: --allow-scene-plugins allows that, or --plugin-dir";
  return text.empty() ? text : " (" + text + ')';
}

void PluginRegistry::ThrowMissing(PluginKind kind, const std::string& name,
                                  const SourceLocation& where) const {
  const std::vector<std::string> available = Available(kind);
  std::string text = "there is no " + Named(kind, name);
  text +=
      available.empty() ? "; no plugin of this kind was found" : "; available: " + Join(available);
  text += PlacesText();
  const std::string advice = AdviceForMissingPlugin(kind, name);
  throw Error(ExitStatus::Scene, text, where,
              advice.empty() ? DidYouMean(name, available) : advice);
}

const PluginDescriptor& PluginRegistry::Load(PluginKind kind, const std::string& name,
                                             const SourceLocation& where) {
  const std::string subject = Named(kind, name);
  if (const std::optional<std::string> fault = FaultOfPluginName(name)) {
    throw Error(ExitStatus::Scene, "the name of " + subject + ' ' + *fault, where);
  }
  const auto substitute = substitutes_.find(Key(kind, name));
  if (substitute != substitutes_.end()) return *substitute->second;
  try {
    const PluginDescriptor* plugin = TryLoad(kind, name);
    if (!plugin) {
      if (const PluginDescriptor* other = Substitute(kind, name, where)) return *other;
      CheckForeignFiles(kind, name);
      ThrowMissing(kind, name, where);
    }
    loaded_.emplace(Key(kind, name), plugin);
    return *plugin;
  } catch (const PluginFileError& error) {
    throw Error(ExitStatus::Scene, "cannot load " + subject + ": " + error.what(), where);
  }
}

const PluginFactory& PluginRegistry::Find(PluginKind kind, const std::string& name,
                                          const SourceLocation& where) {
  const PluginDescriptor& plugin = Load(kind, name, where);
  if (const PluginFactory* factory = FactoryOf(plugin, kind)) return *factory;
  const std::string is =
      plugin.factories.empty() ? "nothing" : PluginKindName(plugin.factories[0].kind);
  const std::vector<std::string> available = Available(kind);
  throw Error(ExitStatus::Scene,
              '"' + name + "\" has the kind " + is + ", not " + PluginKindName(kind) +
                  "; available: " + Join(available),
              where, DidYouMean(name, available));
}

std::vector<std::string> PluginRegistry::Available(PluginKind kind) const {
  std::vector<std::string> names;
  for (const PluginEntry entry : StaticPlugins()) {
    if (FactoryOf(*entry(), kind)) names.push_back(entry()->name);
  }
  for (const std::string& name : PluginNamesIn(folders_, kind)) {
    try {
      const PluginDescriptor* plugin = TryLoad(kind, name);
      if (plugin && FactoryOf(*plugin, kind)) names.push_back(name);
    } catch (const PluginFileError&) {
      // Errors of plugins that cannot be loaded are reported when a scene names them.
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

const std::vector<ParamDecl>* PluginRegistry::Declarations(PluginKind kind,
                                                           const std::string& name) const {
  try {
    const PluginDescriptor* plugin = TryLoad(kind, name);
    const PluginFactory* factory = plugin ? FactoryOf(*plugin, kind) : nullptr;
    return factory ? &factory->parameters->Declarations() : nullptr;
  } catch (const PluginFileError&) {
    return nullptr;
  }
}

std::vector<std::string> PluginRegistry::Loaded() const {
  std::vector<std::string> keys;
  for (const auto& [key, plugin] : loaded_) keys.push_back(key);
  return keys;
}

const std::vector<std::string>& PluginRegistry::KnownNames(PluginKind kind) {
  const auto [entry, isNew] = knownNames_.try_emplace(kind);
  if (isNew) entry->second = Available(kind);
  return entry->second;
}

const std::vector<std::string>& PluginRegistry::ParameterNames(PluginKind kind) {
  const auto [entry, isNew] = parameterNames_.try_emplace(kind);
  std::vector<std::string>& names = entry->second;
  if (!isNew) return names;
  for (const std::string& name : KnownNames(kind)) {
    for (const ParamDecl& decl :
         FactoryOf(*TryLoad(kind, name), kind)->parameters->Declarations()) {
      names.push_back(decl.name);
    }
  }
  return names;
}

void* PluginRegistry::CreateErased(PluginKind kind, const std::string& name, const ParamSet& params,
                                   BindContext bind, const void* context) {
  const PluginFactory& factory = Find(kind, name, params.where);
  if (bind.what.empty()) bind.what = Named(kind, name);
  if (!bind.siblingNames) bind.siblingNames = [this, kind] { return ParameterNames(kind); };
  const std::string failed = bind.what + " cannot be made: ";
  try {
    std::optional<ParamSet> converted;
    if (substitutes_.contains(Key(kind, name)))
      converted = ParamsOfSubstitute(kind, name, params, bind);
    if (void* product = factory.create(factory, converted ? *converted : params, bind, context))
      return product;
  } catch (const Error& error) {
    if (error.Where() || error.Status() != ExitStatus::Scene) throw;
    throw Error(error.Status(), error.what(), params.where, error.Hint());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(ExitStatus::Scene, failed + error.what(), params.where);
  } catch (...) {
    throw Error(ExitStatus::Scene, failed + "it threw an exception without a message",
                params.where);
  }
  throw Error(ExitStatus::Scene, failed + "its plugin returned no object", params.where);
}

}  // namespace exphoton
