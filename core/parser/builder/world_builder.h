// SPDX-License-Identifier: BSD-2-Clause
// WorldBuilder makes the shapes, lights, materials, textures and instances of one scene from the
// directives between WorldBegin and WorldEnd. SceneBuilder handles blocks and transformations.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/base/statistics.h"
#include "core/parser/builder/graphics_state.h"
#include "core/parser/render_setup.h"
#include "core/parser/syntax/directive.h"
#include "core/plugins/registry.h"
#include "core/scene/scene.h"

namespace exphoton {

// AcceleratorSpec names the accelerator plugin for the world and for each object.
struct AcceleratorSpec {
  std::string name;
  ParamSet params;
  int threads = 1;  // for building it; 0: one per core
};

class WorldBuilder {
 public:
  // `transformTimes` are the times of the start and end transformations.
  WorldBuilder(PluginRegistry& registry, Log& log, const LoadOptions& options, Dialect dialect,
               AcceleratorSpec accelerator, Interval transformTimes);

  void AddLight(const Directive& directive, const GraphicsState& state);
  void AddVolume(const Directive& directive, const GraphicsState& state);
  void AddShape(Directive directive, const GraphicsState& state);
  void DefineTexture(const Directive& directive, GraphicsState* state);
  // Checks that the plugin exists. The first shape that uses the material instantiates it.
  // A parameter "namedmaterial..." means the material that `named` has now.
  std::shared_ptr<MaterialSpec> MakeMaterialSpec(std::string name, ParamSet params,
                                                 const MaterialMap& named);
  std::shared_ptr<AreaLightSpec> MakeAreaLightSpec(Directive directive);

  void BeginObject(const Directive& directive);
  void EndObject();
  void AddInstance(const Directive& directive, const GraphicsState& state);
  bool IsInObject() const { return object_ != nullptr; }
  bool HasMedia() const { return !parts_.media.empty(); }

  // Returns the finished world. Nothing may be added afterwards.
  SceneParts Take();
  const SceneNames& Names() const { return names_; }
  // Returns the time spent on building accelerators so far, as phase "accelerator".
  const Statistics& Times() const { return times_; }

 private:
  struct ObjectDefinition {
    std::unique_ptr<PrimitiveSet> set = std::make_unique<PrimitiveSet>();
    const ObjectGeometry* geometry = nullptr;  // built for the first instance
    std::vector<Instance> moving;              // parts that move within the object
    SourceLocation where;
  };

  BindContext Bind(PluginKind kind, const std::string& name, const TextureLookup* textures) const;
  std::unique_ptr<Aggregate> MakeAggregate(PrimitiveSet& set);
  const ObjectGeometry* MakeObject(std::unique_ptr<PrimitiveSet> set);
  class NamedParts;
  // Returns the material with these parameters of a shape, and keeps it in the scene.
  const Material* MaterialFor(MaterialSpec& spec, const ParamSet& shape,
                              const GraphicsState& state);
  std::shared_ptr<const Material> MakeMaterial(MaterialSpec& spec, const ParamSet& shape,
                                               const GraphicsState& state);
  const AreaLight* AreaLightFor(const AreaLightSpec* spec,
                                std::shared_ptr<const EmitterSurface> surface,
                                const Directive& shape, const GraphicsState& state);
  // Returns the shape's motion, or null if the shape does not move.
  std::shared_ptr<const Motion> MotionFor(const Directive& directive,
                                          const GraphicsState& state) const;
  bool Declares(PluginKind kind, const std::string& plugin, const std::string& parameter,
                const SourceLocation& where);
  // A shape can give parameters of its material, which then override the material's directive. A
  // parameter that both declare, such as "filename", is the shape's.
  struct SplitParams {
    ParamSet ofShape, ofMaterial;
  };
  SplitParams SplitByUse(const std::string& shape, const std::string& material, ParamSet params);
  struct Placed {  // the arguments of AddGeometry that depend on motion
    ShapeGeometry geometry;
    PrimitiveSet& set;
    const Motion* motion;  // of the set; null: static
  };
  void AddGeometry(Placed placed, const Material* material, const Directive& directive,
                   const GraphicsState& state);

  PluginRegistry& registry_;
  Log& log_;
  bool isStrict_;
  Dialect dialect_;
  SceneLimits limits_;
  AcceleratorSpec accelerator_;
  Interval transformTimes_;
  Statistics times_;
  SceneParts parts_;
  std::map<std::string, ObjectDefinition> objects_;
  ObjectDefinition* object_ = nullptr;  // the object being defined; null outside ObjectBegin
  // Numbers for the AOVs objectId and materialId.
  std::uint32_t objectCount_ = 0;
  std::map<const Material*, std::uint32_t> materialIds_;
  SceneNames names_;  // of these numbers
  int textureGenerations_ = 0;
  int materialDepth_ = 0;  // materials that are being made, each for the one before
  SharedCache shared_;
};

}  // namespace exphoton
