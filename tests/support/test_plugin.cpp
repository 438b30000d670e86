// SPDX-License-Identifier: BSD-2-Clause
// TestPlugins parses one directive from memory and creates the plugin by the registry.
#include "tests/support/test_plugin.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <new>

#include "core/base/error.h"
#include "core/parser/syntax/parser.h"

namespace exphoton {
namespace {

class OneDirective final : public DirectiveHandler {
 public:
  void Handle(Directive directive) override { directive_ = std::move(directive); }
  void Finish(const SourceLocation&) override {}
  const Directive& Get() const { return directive_; }

 private:
  Directive directive_;
};

// DataLimit limits the data of this process until it is destroyed.
class DataLimit {
 public:
  explicit DataLimit(int megabytes) {
    getrlimit(RLIMIT_DATA, &before_);
    const rlimit limit{rlim_t(megabytes) << 20, before_.rlim_max};
    setrlimit(RLIMIT_DATA, &limit);
  }
  ~DataLimit() { setrlimit(RLIMIT_DATA, &before_); }
  DataLimit(const DataLimit&) = delete;
  DataLimit& operator=(const DataLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

class TestPlugins::Textures final : public TextureLookup {
 public:
  TexturePtr<Real> Float(const std::string& name) const override { return Get(floats, name); }
  TexturePtr<Spectrum> Color(const std::string& name) const override { return Get(colors, name); }
  std::vector<std::string> Names() const override { return {}; }

  std::map<std::string, TexturePtr<Real>> floats;
  std::map<std::string, TexturePtr<Spectrum>> colors;

 private:
  template <class T>
  static TexturePtr<T> Get(const std::map<std::string, TexturePtr<T>>& all,
                           const std::string& name) {
    const auto found = all.find(name);
    return found == all.end() ? nullptr : found->second;
  }
};

TestPlugins::TestPlugins()
    : registry_({std::string(EXPHOTON_BINARY_DIR) + "/plugins"}, &log_),
      textures_(std::make_shared<Textures>()) {}

void TestPlugins::Define(const std::string& name, TexturePtr<Real> texture) {
  textures_->floats[name] = std::move(texture);
}
void TestPlugins::Define(const std::string& name, TexturePtr<Spectrum> texture) {
  textures_->colors[name] = std::move(texture);
}

template <PluginKind kind>
std::unique_ptr<typename PluginTraits<kind>::Product> TestPlugins::Make(
    const std::string& text, const typename PluginTraits<kind>::Context& context) {
  // All directives with a name and parameters have the same syntax, so "Shape" does for each.
  MemorySource source({{"test.pbrt", "Shape " + text + "\n"}});
  OneDirective handler;
  ParseScene(source, "test.pbrt", handler, log_);
  BindContext bind;
  bind.log = &log_;
  bind.textures = textures_.get();
  return registry_.Create<kind>(handler.Get().strings.at(0), handler.Get().params, bind, context);
}

std::unique_ptr<Light> TestPlugins::MakeLight(const std::string& text, const Transform& toWorld) {
  return Make<PluginKind::Light>(text, {toWorld, log_, {}});
}

std::unique_ptr<AreaLight> TestPlugins::MakeAreaLight(
    const std::string& text, std::shared_ptr<const EmitterSurface> surface) {
  return Make<PluginKind::AreaLight>(text, {std::move(surface), log_, {}});
}

ShapeGeometry TestPlugins::MakeShape(const std::string& text, const Transform& toWorld,
                                     bool reverseOrientation) {
  return std::move(*Make<PluginKind::Shape>(text, {toWorld, reverseOrientation, log_, {}}));
}

std::unique_ptr<Aggregate> TestPlugins::MakeAccelerator(const std::string& text,
                                                        const PrimitiveSet& primitives,
                                                        int threads) {
  return Make<PluginKind::Accelerator>(text, {primitives, log_, threads});
}

std::unique_ptr<Camera> TestPlugins::MakeCamera(const std::string& text, const Transform& toWorld,
                                                int xResolution, int yResolution) {
  return Make<PluginKind::Camera>(text, {toWorld, xResolution, yResolution});
}

std::unique_ptr<Sampler> TestPlugins::MakeSampler(const std::string& text) {
  return Make<PluginKind::Sampler>(text, {log_, {}});
}

std::unique_ptr<Material> TestPlugins::MakeMaterial(const std::string& text) {
  return Make<PluginKind::Material>(text, {log_, {}});
}

std::unique_ptr<FloatTexture> TestPlugins::MakeFloatTexture(const std::string& text,
                                                            const Transform& toWorld) {
  return Make<PluginKind::FloatTexture>(text, {toWorld, log_, {}, shared_});
}

std::unique_ptr<ColorTexture> TestPlugins::MakeColorTexture(const std::string& text,
                                                            const Transform& toWorld) {
  return Make<PluginKind::ColorTexture>(text, {toWorld, log_, {}, shared_});
}

std::unique_ptr<Filter> TestPlugins::MakeFilter(const std::string& text) {
  return Make<PluginKind::Filter>(text, {});
}

std::shared_ptr<const EmitterSurface> TestPlugins::MakeEmitter(const std::string& text,
                                                               const Transform& toWorld,
                                                               bool reverseOrientation) {
  ShapeGeometry geometry = MakeShape(text, toWorld, reverseOrientation);
  if (auto* shape = std::get_if<std::unique_ptr<Shape>>(&geometry)) return std::move(*shape);
  meshes_.push_back(std::move(std::get<std::unique_ptr<TriangleMesh>>(geometry)));
  return MakeMeshEmitter(*meshes_.back());
}

std::string RefusalForMemory(const std::string& text, int megabytes) {
  TestPlugins plugins;
  try {
    const DataLimit limit(megabytes);
    plugins.MakeShape(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.Status(), ExitStatus::Resource);
    return error.what();
  } catch (const std::bad_alloc&) {
    ADD_FAILURE() << "the shape was begun, and ran out of memory";
    return "";
  }
  ADD_FAILURE() << "the shape was made";
  return "";
}

}  // namespace exphoton
