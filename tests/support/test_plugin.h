// SPDX-License-Identifier: BSD-2-Clause
// TestPlugins makes single plugins from scene text, for tests of a light, shape or material without
// a scene:
//   TestPlugins plugins;
//   auto light = plugins.MakeLight(R"("spot" "float coneangle" 20)");
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/log.h"
#include "core/plugins/registry.h"

namespace exphoton {

class TestPlugins {
 public:
  TestPlugins();

  // `text` is the plugin's name in quotes and its parameters, as they follow a directive.
  std::unique_ptr<Light> MakeLight(const std::string& text, const Transform& toWorld = {});
  std::unique_ptr<AreaLight> MakeAreaLight(const std::string& text,
                                           std::shared_ptr<const EmitterSurface> surface);
  ShapeGeometry MakeShape(const std::string& text, const Transform& toWorld = {},
                          bool reverseOrientation = false);
  std::unique_ptr<Aggregate> MakeAccelerator(const std::string& text,
                                             const PrimitiveSet& primitives, int threads = 1);
  // Returns the shape as a surface to sample. TestPlugins keeps the mesh that the surface refers
  // to.
  std::shared_ptr<const EmitterSurface> MakeEmitter(const std::string& text,
                                                    const Transform& toWorld = {},
                                                    bool reverseOrientation = false);
  std::unique_ptr<Camera> MakeCamera(const std::string& text, const Transform& toWorld,
                                     int xResolution, int yResolution);
  std::unique_ptr<Sampler> MakeSampler(const std::string& text);
  std::unique_ptr<Filter> MakeFilter(const std::string& text);
  std::unique_ptr<Material> MakeMaterial(const std::string& text);
  std::unique_ptr<FloatTexture> MakeFloatTexture(const std::string& text,
                                                 const Transform& toWorld = {});
  std::unique_ptr<ColorTexture> MakeColorTexture(const std::string& text,
                                                 const Transform& toWorld = {});
  // Defines a texture that "texture" parameters of later texts may name.
  void Define(const std::string& name, TexturePtr<Real> texture);
  void Define(const std::string& name, TexturePtr<Spectrum> texture);

  Log& GetLog() { return log_; }
  PluginRegistry& Registry() { return registry_; }

 private:
  template <PluginKind kind>
  std::unique_ptr<typename PluginTraits<kind>::Product> Make(
      const std::string& text, const typename PluginTraits<kind>::Context& context);

  Log log_{Log::Level::Normal, Log::Sink::Memory};
  PluginRegistry registry_;
  class Textures;
  std::shared_ptr<Textures> textures_;
  SharedCache shared_;
  std::vector<std::unique_ptr<TriangleMesh>> meshes_;
};

// Makes a shape while the data of this process are limited to `megabytes`, and expects an error of
// status Resource. Returns its message. Running out of memory instead fails the test.
std::string RefusalForMemory(const std::string& text, int megabytes);

}  // namespace exphoton
