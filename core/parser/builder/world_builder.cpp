// SPDX-License-Identifier: BSD-2-Clause
// WorldBuilder makes shapes with their materials and area lights, lights, media and textures. The
// file world_objects.cpp handles objects and instances.
#include "core/parser/builder/world_builder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/log.h"
#include "core/geometry/moving_emitter.h"

namespace exphoton {
namespace {

// Materials are made recursively, so longer chains could overflow the stack.
constexpr int kMaxMaterialDepth = 32;

void RequireRest(const GraphicsState& state, const Directive& directive, const std::string& what) {
  if (!state.transform.Moves()) return;
  FailAt(directive.Where(),
         what + " cannot move; shapes, area lights on them, instances and the camera can",
         "the transformation is not the same at StartTime and EndTime");
}

// Refuses a texture whose lookup could overflow the stack or take too long.
void CheckGraph(const TextureGraph& graph, const Directive& directive, const SceneLimits& limits) {
  const std::string subject = "texture \"" + directive.strings[0] + "\" ";
  if (graph.depth > kMaxTextureDepth)
    FailAt(directive.Where(), subject + "is the top of a chain of more than " +
                                  std::to_string(kMaxTextureDepth) +
                                  " textures that use each other");
  if (graph.nodes > limits.textureNodes)
    FailAt(directive.Where(),
           subject + "evaluates more than " + std::to_string(limits.textureNodes) +
               " textures a lookup, because textures below it are used several times",
           "--limits texturenodes=N allows N of them");
}

}  // namespace

WorldBuilder::WorldBuilder(PluginRegistry& registry, Log& log, const LoadOptions& options,
                           Dialect dialect, AcceleratorSpec accelerator, Interval transformTimes)
    : registry_(registry),
      log_(log),
      isStrict_(options.isStrict),
      dialect_(dialect),
      limits_(options.limits),
      accelerator_(std::move(accelerator)),
      transformTimes_(transformTimes) {
  parts_.primitives = std::make_unique<PrimitiveSet>();
}

BindContext WorldBuilder::Bind(PluginKind kind, const std::string& name,
                               const TextureLookup* textures) const {
  BindContext bind;
  bind.textures = textures;
  bind.log = &log_;
  bind.isStrict = isStrict_;
  bind.dialect = dialect_;
  bind.what = std::string(PluginKindName(kind)) + " \"" + name + "\"";
  return bind;
}

void WorldBuilder::AddLight(const Directive& directive, const GraphicsState& state) {
  if (IsInObject())
    log_.Warning(
        "a light in an object is not repeated with its instances: it shines once, where "
        "the object is defined",
        directive.Where());
  RequireRest(state, directive, "a light source");
  const std::string& name = directive.strings[0];
  parts_.lights.push_back(registry_.Create<PluginKind::Light>(
      name, directive.params, Bind(PluginKind::Light, name, state.textures.get()),
      LightContext{state.transform.start, log_, directive.Where()}));
  parts_.lightOrigins.push_back({name, directive.Where()});
}

void WorldBuilder::AddVolume(const Directive& directive, const GraphicsState& state) {
  if (IsInObject())
    log_.Warning("a volume in an object is not repeated with its instances", directive.Where());
  RequireRest(state, directive, "a volume");
  const std::string& name = directive.strings[0];
  parts_.media.push_back(registry_.Create<PluginKind::Volume>(
      name, directive.params, Bind(PluginKind::Volume, name, state.textures.get()),
      MediumContext{state.transform.start, log_, directive.Where()}));
}

namespace {

// Replaces a constant texture by its ConstantValue. Feature culling relies on that value, so
// Evaluate must return it exactly: a mix of 1 and 1 can be off by a rounding error, which would
// make an opaque surface let light through.
template <class T>
TexturePtr<T> WithoutRounding(TexturePtr<T> texture) {
  const auto value = texture->ConstantValue();
  return value ? Uniform(*value) : texture;
}

}  // namespace

void WorldBuilder::DefineTexture(const Directive& directive, GraphicsState* state) {
  const std::string &name = directive.strings[0], &type = directive.strings[1],
                    &plugin = directive.strings[2];
  const bool isColor = type == "color" || type == "spectrum";
  if (!isColor && type != "float")
    FailAt(directive.Where(), "texture \"" + name + "\" has type \"" + type +
                                  "\"; types of textures are \"float\" and \"color\"");
  if (state->transform.Moves())
    log_.Warning("a texture does not move: it uses the transformation at StartTime",
                 directive.Where());
  const TextureContext context{state->transform.start, log_, directive.Where(), shared_};
  const TextureUse use(*state->textures);
  TexturePtr<Real> floats;
  TexturePtr<Spectrum> colors;
  if (isColor)
    colors = WithoutRounding<Spectrum>(registry_.Create<PluginKind::ColorTexture>(
        plugin, directive.params, Bind(PluginKind::ColorTexture, plugin, &use), context));
  else
    floats = WithoutRounding<Real>(registry_.Create<PluginKind::FloatTexture>(
        plugin, directive.params, Bind(PluginKind::FloatTexture, plugin, &use), context));
  const TextureGraph graph = use.Above();
  CheckGraph(graph, directive, limits_);
  const bool isKnown = state->textures->Has(name, isColor);
  if (isKnown)
    log_.Warning("texture \"" + name + "\" is defined again: later shapes use the new one",
                 directive.Where());
  TextureTable& table = state->OwnTextures();
  table.generation = ++textureGenerations_;
  if (isColor)
    table.Define(name, std::move(colors), graph);
  else
    table.Define(name, std::move(floats), graph);
}

std::shared_ptr<MaterialSpec> WorldBuilder::MakeMaterialSpec(std::string name, ParamSet params,
                                                             const MaterialMap& named) {
  registry_.Find(PluginKind::Material, name, params.where);
  auto spec = std::make_shared<MaterialSpec>();
  for (const ParsedParam& param : params.All()) {
    if (!param.name.starts_with("namedmaterial") || param.strings.size() != 1) continue;
    const auto found = named.find(param.strings[0]);
    if (found != named.end()) spec->parts.insert(*found);
  }
  spec->name = std::move(name);
  spec->params = std::move(params);
  return spec;
}

std::shared_ptr<AreaLightSpec> WorldBuilder::MakeAreaLightSpec(Directive directive) {
  registry_.Find(PluginKind::AreaLight, directive.strings[0], directive.Where());
  return std::make_shared<AreaLightSpec>(
      AreaLightSpec{std::move(directive.strings[0]), std::move(directive.params)});
}

bool WorldBuilder::Declares(PluginKind kind, const std::string& plugin,
                            const std::string& parameter, const SourceLocation& where) {
  const auto& declared = registry_.Find(kind, plugin, where).parameters->Declarations();
  return std::any_of(declared.begin(), declared.end(),
                     [&](const ParamDecl& decl) { return decl.name == parameter; });
}

WorldBuilder::SplitParams WorldBuilder::SplitByUse(const std::string& shape,
                                                   const std::string& material, ParamSet params) {
  const auto isMaterialOnly = [&](const ParsedParam& param) {
    return !Declares(PluginKind::Shape, shape, param.name, params.where) &&
           Declares(PluginKind::Material, material, param.name, params.where);
  };
  SplitParams split;
  split.ofShape.where = split.ofMaterial.where = params.where;
  const std::vector<ParsedParam>& all = params.All();
  if (std::none_of(all.begin(), all.end(), isMaterialOnly)) {
    split.ofShape = std::move(params);
    return split;
  }
  for (const ParsedParam& param : all)
    (isMaterialOnly(param) ? split.ofMaterial : split.ofShape).Add(param);
  return split;
}

namespace {

// Returns whether a material may depend on textures: by its parameters, or by materials that it
// names.
bool RefersToTextures(const ParamSet& params) {
  return std::any_of(params.All().begin(), params.All().end(), [](const ParsedParam& param) {
    return param.type == "texture" || param.type == "string";
  });
}

}  // namespace

// NamedParts finds the materials that a material refers to, for its factory: those of its
// directive, and those that a shape's own parameters name.
class WorldBuilder::NamedParts final : public MaterialLookup {
 public:
  NamedParts(WorldBuilder& world, const MaterialSpec& spec, const GraphicsState& state)
      : world_(world), spec_(spec), state_(state) {}

  std::shared_ptr<const Material> Find(const std::string& name) const override {
    const MaterialMap* const scopes[] = {&spec_.parts, state_.namedMaterials.get()};
    for (const MaterialMap* materials : scopes) {
      const auto found = materials->find(name);
      if (found != materials->end()) return world_.MakeMaterial(*found->second, {}, state_);
    }
    return nullptr;
  }
  std::vector<std::string> Names() const override {
    std::vector<std::string> names;
    for (const auto& [name, spec] : *state_.namedMaterials) names.push_back(name);
    return names;
  }

 private:
  WorldBuilder& world_;
  const MaterialSpec& spec_;
  const GraphicsState& state_;
};

const Material* WorldBuilder::MaterialFor(MaterialSpec& spec, const ParamSet& shape,
                                          const GraphicsState& state) {
  const std::shared_ptr<const Material> material = MakeMaterial(spec, shape, state);
  // The scene owns the materials of its shapes. AOVs number them in the order of the file.
  if (spec.listed != material.get()) {
    parts_.materials.push_back(material);
    spec.listed = material.get();
    const auto number = std::uint32_t(materialIds_.size() + 1);
    if (materialIds_.try_emplace(material.get(), number).second)
      names_.AddMaterial(spec.label.empty() ? spec.name : spec.label, !spec.label.empty());
  }
  return material.get();
}

std::shared_ptr<const Material> WorldBuilder::MakeMaterial(MaterialSpec& spec,
                                                           const ParamSet& shape,
                                                           const GraphicsState& state) {
  const bool overrides = !shape.All().empty();
  const TextureTable& textures = spec.textures ? *spec.textures : *state.textures;
  const bool isUpToDate =
      spec.madeGeneration == textures.generation || !RefersToTextures(spec.params);
  if (!overrides && spec.made && isUpToDate) return spec.made;
  BindContext bind = Bind(PluginKind::Material, spec.name, &textures);
  if (overrides) bind.overrides = &shape, bind.overrideTextures = state.textures.get();
  if (materialDepth_ >= kMaxMaterialDepth)
    FailAt(spec.params.where, "material \"" + spec.name + "\" is the end of a chain of more than " +
                                  std::to_string(kMaxMaterialDepth) +
                                  " materials that refer to each other");
  struct Depth {
    int& depth;
    ~Depth() { --depth; }
  };
  const Depth depth{++materialDepth_};
  const NamedParts parts(*this, spec, state);
  std::shared_ptr<const Material> material = registry_.Create<PluginKind::Material>(
      spec.name, spec.params, std::move(bind),
      MaterialContext{log_, spec.params.where, &parts, &shared_});
  if (!overrides) {
    spec.made = material;
    spec.madeGeneration = textures.generation;
  }
  return material;
}

const AreaLight* WorldBuilder::AreaLightFor(const AreaLightSpec* spec,
                                            std::shared_ptr<const EmitterSurface> surface,
                                            const Directive& shape, const GraphicsState& state) {
  if (!spec) return nullptr;
  if (IsInObject()) {
    log_.Warning("a shape in an object cannot be an area light: it does not emit", shape.Where());
    return nullptr;
  }
  // If the surface has a problem, the light's factory reports it, so the area is not checked here.
  const Real area = surface->EmitterProblem() ? Real(1) : surface->Area();
  if (!(area > 0) || !std::isfinite(area)) {
    log_.Warning(area == 0 ? "an area light of area 0 does not emit"
                           : "an area light whose area is not a finite number does not emit",
                 shape.Where());
    return nullptr;
  }
  std::unique_ptr<AreaLight> light = registry_.Create<PluginKind::AreaLight>(
      spec->name, spec->params, Bind(PluginKind::AreaLight, spec->name, state.textures.get()),
      AreaLightContext{std::move(surface), log_, spec->params.where});
  const AreaLight* made = light.get();
  parts_.lights.push_back(std::move(light));
  parts_.lightOrigins.push_back({spec->name, shape.Where()});
  return made;
}

void WorldBuilder::AddShape(Directive directive, const GraphicsState& state) {
  const std::string& name = directive.strings[0];
  if (!object_) {
    ++objectCount_;
    names_.AddObject(name);
  }
  const SourceLocation where = directive.Where();
  const SplitParams params =
      SplitByUse(name, state.material->name, std::exchange(directive.params, {}));
  directive.params.where = where;
  const Material* material = MaterialFor(*state.material, params.ofMaterial, state);
  const std::shared_ptr<const Motion> motion = MotionFor(directive, state);
  // A moving shape is made in object space in a separate set, and an instance with the motion
  // places that set in the world.
  const Transform toWorld = motion ? Transform() : state.transform.start;
  std::unique_ptr<ShapeGeometry> geometry = registry_.Create<PluginKind::Shape>(
      name, params.ofShape, Bind(PluginKind::Shape, name, state.textures.get()),
      ShapeContext{toWorld, state.reverseOrientation, log_, where});
  PrimitiveSet& world = object_ ? *object_->set : *parts_.primitives;
  if (!motion)
    return AddGeometry({std::move(*geometry), world, nullptr}, material, directive, state);
  auto set = std::make_unique<PrimitiveSet>();
  AddGeometry({std::move(*geometry), *set, motion.get()}, material, directive, state);
  const Instance instance{motion->Start(), MakeObject(std::move(set)), motion};
  if (instance.object->Set().Count() == 0) return;
  if (object_)
    object_->moving.push_back(instance);
  else
    world.AddInstance(instance);
}

std::shared_ptr<const Motion> WorldBuilder::MotionFor(const Directive& directive,
                                                      const GraphicsState& state) const {
  if (!state.transform.Moves()) return nullptr;
  return std::make_shared<Motion>(MotionBetween(state.transform, transformTimes_,
                                                directive.strings[0], directive.Where(), log_));
}

void WorldBuilder::AddGeometry(Placed placed, const Material* material, const Directive& directive,
                               const GraphicsState& state) {
  const AreaLightSpec* light = state.areaLight.get();
  const std::uint32_t objectId = object_ ? 0 : objectCount_;  // in an object: of the instance
  const auto lightOn = [&](std::shared_ptr<const EmitterSurface> surface) {
    if (light && placed.motion && !IsInObject())
      surface = std::make_shared<MovingEmitter>(std::move(surface), *placed.motion);
    return AreaLightFor(light, std::move(surface), directive, state);
  };
  if (auto* owned = std::get_if<std::unique_ptr<Shape>>(&placed.geometry)) {
    const std::shared_ptr<const Shape> shape = std::move(*owned);
    placed.set.AddShape(shape, {material, lightOn(shape), objectId, materialIds_[material]});
    return;
  }
  const std::shared_ptr<TriangleMesh> mesh =
      std::move(std::get<std::unique_ptr<TriangleMesh>>(placed.geometry));
  if (mesh->TriangleCount() == 0) return;
  std::shared_ptr<const EmitterSurface> surface;
  if (light && !IsInObject()) {
    if (mesh->alpha)
      log_.Warning("alpha does not cut holes into a shape that emits", directive.Where());
    mesh->alpha = nullptr;
    surface = MakeMeshEmitter(*mesh);
    parts_.emitters.push_back(surface);
  }
  placed.set.AddMesh(mesh, {material, lightOn(surface), objectId, materialIds_[material]});
}

}  // namespace exphoton
