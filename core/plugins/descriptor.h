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
inline constexpr std::uint32_t kPluginAbi = 15;
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
  std::vector<PluginFactory> factories;
};

// Makes a plugin factory from a parameter table and a function
//   std::unique_ptr<Product>(const S&, const Context&)
template <PluginKind kind, class S, class Create>
PluginFactory MakeFactory(const ParamTable<S>& table, Create create) {
  using Context = typename PluginTraits<kind>::Context;
  using Product = typename PluginTraits<kind>::Product;
  return {kind, &table,
          [&table, create](const ParamSet& params, const BindContext& bind, const void* context) {
            const S settings = table.Bind(params, bind);
            std::unique_ptr<Product> product = table.Guard(params, bind, [&] {
              return create(settings, *static_cast<const Context*>(context));
            });
            return static_cast<void*>(product.release());
          }};
}

using PluginEntry = const PluginDescriptor* (*)();
inline constexpr const char* kPluginSymbol = "ExphotonPlugin";

// For builds with all plugins linked in. EXPHOTON_PLUGIN calls this before main.
bool RegisterStaticPlugin(PluginEntry entry);

}  // namespace exphoton

// EXPHOTON_MATERIAL("matte", "diffuse reflection") registers a plugin of one kind. The file
// defines, in namespace exphoton (usually unnamed within it), the table of its parameters and the
// function that makes the object:
//   const ParamTable<Settings>& Parameters();
//   std::unique_ptr<Material> Create(const Settings&, const MaterialContext&);
#define EXPHOTON_MATERIAL(name, summary) EXPHOTON_REGISTER(Material, name, summary)
#define EXPHOTON_COLOR_TEXTURE(name, summary) EXPHOTON_REGISTER(ColorTexture, name, summary)
#define EXPHOTON_FLOAT_TEXTURE(name, summary) EXPHOTON_REGISTER(FloatTexture, name, summary)
#define EXPHOTON_SHAPE(name, summary) EXPHOTON_REGISTER(Shape, name, summary)
#define EXPHOTON_LIGHT(name, summary) EXPHOTON_REGISTER(Light, name, summary)
#define EXPHOTON_AREA_LIGHT(name, summary) EXPHOTON_REGISTER(AreaLight, name, summary)
#define EXPHOTON_VOLUME(name, summary) EXPHOTON_REGISTER(Volume, name, summary)
#define EXPHOTON_INTEGRATOR(name, summary) EXPHOTON_REGISTER(Integrator, name, summary)
#define EXPHOTON_VOLUME_INTEGRATOR(name, summary) EXPHOTON_REGISTER(VolumeIntegrator, name, summary)
#define EXPHOTON_ACCELERATOR(name, summary) EXPHOTON_REGISTER(Accelerator, name, summary)
#define EXPHOTON_SAMPLER(name, summary) EXPHOTON_REGISTER(Sampler, name, summary)
#define EXPHOTON_FILTER(name, summary) EXPHOTON_REGISTER(Filter, name, summary)
#define EXPHOTON_CAMERA(name, summary) EXPHOTON_REGISTER(Camera, name, summary)

#define EXPHOTON_REGISTER(kind, name, summary)                                                    \
  EXPHOTON_PLUGIN(name, summary,                                                                  \
                  ::exphoton::MakeFactory<::exphoton::PluginKind::kind>(::exphoton::Parameters(), \
                                                                        ::exphoton::Create))

// Registers a plugin of several kinds, or with other names for the table and the function.
//   EXPHOTON_PLUGIN("matte", "diffuse reflection",
//                   exphoton::MakeFactory<exphoton::PluginKind::Material>(Parameters(), Create))
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
