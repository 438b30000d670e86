// SPDX-License-Identifier: BSD-2-Clause
// PluginDescriptor is the result of a plugin's exported function. It describes the plugin and its
// factories, and reading it creates no object. A plugin has one factory, or two if one name has two
// kinds (float and colour textures).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/params/param_table.h"
#include "core/plugins/kinds.h"

namespace exphoton {

// Must be raised with every change of a core interface that plugins see.
inline constexpr std::uint32_t kPluginAbi = 13;
// Compiler, Real and core version. A plugin with another build tag is refused.
const char* CoreBuildTag();
#define EXPHOTON_BUILD_TAG ("exphoton 1, " __VERSION__ ", " EXPHOTON_REAL_NAME)
#ifdef EXPHOTON_DOUBLE
#define EXPHOTON_REAL_NAME "double"
#else
#define EXPHOTON_REAL_NAME "float"
#endif

struct PluginFactory {
  PluginKind kind;
  const ParamTableBase* parameters;
  // Binds the parameters and creates a new PluginTraits<kind>::Product. `context` points to a
  // PluginTraits<kind>::Context. Throws Error.
  std::function<void*(const ParamSet&, const BindContext&, const void* context)> create;
};

struct PluginDescriptor {
  std::uint32_t abi;
  const char* buildTag;
  const char* name;     // the name in scene files and of the plugin file
  const char* summary;  // one line
  std::vector<PluginFactory> forms;
};

// Makes a plugin factory from a settings table and a function
//   std::unique_ptr<Product>(const S&, const Context&)
template <PluginKind kind, class S, class Factory>
PluginFactory MakeForm(const ParamTable<S>& table, Factory factory) {
  using Context = typename PluginTraits<kind>::Context;
  using Product = typename PluginTraits<kind>::Product;
  return {kind, &table,
          [&table, factory](const ParamSet& params, const BindContext& bind, const void* context) {
            const S settings = table.Bind(params, bind);
            std::unique_ptr<Product> product = table.Guard(params, bind, [&] {
              return factory(settings, *static_cast<const Context*>(context));
            });
            return static_cast<void*>(product.release());
          }};
}

using PluginEntry = const PluginDescriptor* (*)();
inline constexpr const char* kPluginSymbol = "ExphotonPlugin";

// For builds with all plugins linked in. EXPHOTON_PLUGIN calls this before main.
bool RegisterStaticPlugin(PluginEntry entry);

}  // namespace exphoton

// Defines the exported function of a plugin, or registers the plugin in a static build.
//   EXPHOTON_PLUGIN("matte", "diffuse reflection",
//                   exphoton::MakeForm<exphoton::PluginKind::Material>(Parameters(), Create))
#ifdef EXPHOTON_STATIC_PLUGINS
#define EXPHOTON_PLUGIN(pluginName, pluginSummary, ...)                                        \
  namespace {                                                                                  \
  const ::exphoton::PluginDescriptor* ExphotonStaticPlugin() {                                 \
    static const ::exphoton::PluginDescriptor descriptor{                                      \
        ::exphoton::kPluginAbi, EXPHOTON_BUILD_TAG, pluginName, pluginSummary, {__VA_ARGS__}}; \
    return &descriptor;                                                                        \
  }                                                                                            \
  [[maybe_unused]] const bool exphotonRegistered =                                             \
      ::exphoton::RegisterStaticPlugin(&ExphotonStaticPlugin);                                 \
  }
#else
#define EXPHOTON_PLUGIN(pluginName, pluginSummary, ...)                                        \
  extern "C" __attribute__((visibility("default"))) const ::exphoton::PluginDescriptor*        \
  ExphotonPlugin() {                                                                           \
    static const ::exphoton::PluginDescriptor descriptor{                                      \
        ::exphoton::kPluginAbi, EXPHOTON_BUILD_TAG, pluginName, pluginSummary, {__VA_ARGS__}}; \
    return &descriptor;                                                                        \
  }
#endif
