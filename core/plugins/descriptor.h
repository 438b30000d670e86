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
inline constexpr std::uint32_t kPluginAbi = 20;
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
  void* (*create)(const PluginFactory& factory, const ParamSet& params, const BindContext& bind,
                  const void* context);
};

struct PluginDescriptor {
  std::uint32_t abi;
  const char* buildTag;
  const char* name;     // the name in scene files and of the plugin file
  const char* summary;  // one line
  std::vector<PluginFactory> factories;
};

// Makes a plugin factory from a parameter table and a function
//   std::unique_ptr<Product> create(const S&, const Context&)
template <PluginKind kind, auto create, class S>
PluginFactory MakeFactory(const ParamTable<S>& table) {
  return {kind, &table,
          [](const PluginFactory& factory, const ParamSet& params, const BindContext& bind,
             const void* context) -> void* {
            using Context = typename PluginTraits<kind>::Context;
            const auto& parameters = static_cast<const ParamTable<S>&>(*factory.parameters);
            const S settings = parameters.Bind(params, bind);
            try {
              std::unique_ptr<typename PluginTraits<kind>::Product> product =
                  create(settings, *static_cast<const Context*>(context));
              return product.release();
            } catch (const ParamError& error) {
              parameters.Locate(error, params, bind);
            }
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
// EXPHOTON_TEXTURE registers a texture of floats and of colours; Parameters<T>() and Create<T> are
// templates over the value type. EXPHOTON_COLOR_TEXTURE and EXPHOTON_FLOAT_TEXTURE register one of
// both.
#define EXPHOTON_TEXTURE(name, summary)                                              \
  EXPHOTON_PLUGIN(name, summary,                                                     \
                  ::exphoton::MakeFactory<::exphoton::PluginKind::FloatTexture,      \
                                          ::exphoton::Create<::exphoton::Real>>(     \
                      ::exphoton::Parameters<::exphoton::Real>()),                   \
                  ::exphoton::MakeFactory<::exphoton::PluginKind::ColorTexture,      \
                                          ::exphoton::Create<::exphoton::Spectrum>>( \
                      ::exphoton::Parameters<::exphoton::Spectrum>()))
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

#define EXPHOTON_REGISTER(kind, name, summary)                                               \
  EXPHOTON_PLUGIN(name, summary,                                                             \
                  ::exphoton::MakeFactory<::exphoton::PluginKind::kind, ::exphoton::Create>( \
                      ::exphoton::Parameters()))

// Registers a plugin with any list of factories. The macros above are defined by it.
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
