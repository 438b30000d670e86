// SPDX-License-Identifier: BSD-2-Clause
// PluginDescriptor: what a plugin's one exported function returns: who it is and what it can make,
// readable without making anything. A plugin has one form, or two where one name serves two kinds
// (a texture of floats and of colours).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/params/param_table.h"
#include "core/plugins/kinds.h"

namespace exphoton {

// Raised with every change of a core interface that plugins see.
inline constexpr std::uint32_t kPluginAbi = 13;
// Compiler, Real and core version: a plugin built with other ones is refused.
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
  // Binds the parameters and makes a new PluginTraits<kind>::Product; `context` points to a
  // PluginTraits<kind>::Context. Throws Error.
  std::function<void*(const ParamSet&, const BindContext&, const void* context)> create;
};

struct PluginDescriptor {
  std::uint32_t abi;
  const char* buildTag;
  const char* name;     // as scene files write it; equals the file's name
  const char* summary;  // one line
  std::vector<PluginFactory> forms;
};

// A form from a settings table and a factory
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

// For a build with every plugin linked in: called before main by EXPHOTON_PLUGIN.
bool RegisterStaticPlugin(PluginEntry entry);

}  // namespace exphoton

// The one exported function of a plugin, or its registration in a static build.
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
