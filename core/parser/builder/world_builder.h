// SPDX-License-Identifier: BSD-2-Clause
// WorldBuilder: what stands between WorldBegin and WorldEnd becomes shapes, lights, materials,
// textures and instances. One a scene; blocks and transformations are scene_builder.h's.
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

// The accelerator that the scene names, made over a finished set.
struct AcceleratorSpec {
  std::string name;
  ParamSet params;
  int threads = 1;  // that may build it; 0: as many as there are cores
};

class WorldBuilder {
 public:
  // transformTimes: between which what moves does so.
  WorldBuilder(PluginRegistry& registry, Log& log, const LoadOptions& options,
               AcceleratorSpec accelerator, Interval transformTimes);

  void AddLight(const Directive& directive, const GraphicsState& state);
  void AddVolume(const Directive& directive, const GraphicsState& state);
  void AddShape(Directive directive, const GraphicsState& state);
  void DefineTexture(const Directive& directive, GraphicsState* state);
  // Checks the name; the object is made by the first shape that wears it.
  std::shared_ptr<MaterialSpec> MakeMaterialSpec(std::string name, ParamSet params);
  std::shared_ptr<AreaLightSpec> MakeAreaLightSpec(Directive directive);

  void BeginObject(const Directive& directive);
  void EndObject();
  void AddInstance(const Directive& directive, const GraphicsState& state);
  bool IsInObject() const { return object_ != nullptr; }

  // The finished world. Nothing may be added after it.
  SceneParts Take();
  // What building accelerators has taken so far, as phase "accelerator".
  const Statistics& Times() const { return times_; }

 private:
  struct ObjectDefinition {
    std::unique_ptr<PrimitiveSet> set = std::make_unique<PrimitiveSet>();
    const ObjectGeometry* geometry = nullptr;  // once an instance needed it
    std::vector<Instance> moving;              // parts that move within the object
    SourceLocation where;
  };

  BindContext Bind(PluginKind kind, const std::string& name, const TextureLookup* textures) const;
  std::unique_ptr<Aggregate> MakeAggregate(PrimitiveSet& set);
  const ObjectGeometry* MakeObject(std::unique_ptr<PrimitiveSet> set);
  const Material* MaterialFor(MaterialSpec& spec, const ParamSet& shape,
                              const GraphicsState& state);
  const AreaLight* AreaLightFor(const AreaLightSpec* spec,
                                std::shared_ptr<const EmitterSurface> surface,
                                const Directive& shape, const GraphicsState& state);
  // The shape's motion; null where it rests.
  std::shared_ptr<const Motion> MotionFor(const Directive& directive,
                                          const GraphicsState& state) const;
  bool Declares(PluginKind kind, const std::string& plugin, const std::string& parameter,
                const SourceLocation& where);
  // A shape's parameters without those that only its material knows.
  ParamSet WithoutMaterialParameters(const std::string& shape, const std::string& material,
                                     ParamSet params);
  struct Placed {  // what AddGeometry adds, and to what
    ShapeGeometry geometry;
    PrimitiveSet& set;
    const Motion* motion;  // of the set; null: it rests
  };
  void AddGeometry(Placed placed, const Material* material, const Directive& directive,
                   const GraphicsState& state);

  PluginRegistry& registry_;
  Log& log_;
  bool isStrict_;
  SceneLimits limits_;
  AcceleratorSpec accelerator_;
  Interval transformTimes_;
  Statistics times_;
  SceneParts parts_;
  std::map<std::string, ObjectDefinition> objects_;
  ObjectDefinition* object_ = nullptr;  // the one being defined
  int textureGenerations_ = 0;
  SharedCache shared_;
};

}  // namespace exphoton
