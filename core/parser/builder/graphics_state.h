// SPDX-License-Identifier: BSD-2-Clause
// GraphicsState is the state that AttributeBegin saves and AttributeEnd restores: transformation,
// material, area light, orientation and the textures and materials named so far. It is cheap to
// copy.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/params/param_set.h"
#include "core/parser/builder/moving_transform.h"
#include "core/parser/builder/texture_table.h"
#include "core/scattering/material.h"

namespace exphoton {

struct MaterialSpec;
using MaterialMap = std::map<std::string, std::shared_ptr<MaterialSpec>>;

// MaterialSpec stores the directive Material or MakeNamedMaterial. The first shape that uses it
// instantiates the Material. Later shapes share the object.
struct MaterialSpec {
  std::string name;
  std::string label;  // the name that MakeNamedMaterial gives; else empty
  ParamSet params;
  MaterialMap parts;  // the named materials that the parameters refer to
  // A material of MakeNamedMaterial keeps the textures that its parameters name, as defined there.
  // Null: the parameters name textures that are known at the shape.
  std::shared_ptr<const TextureTable> textures;

  std::shared_ptr<const Material> made;
  int madeGeneration = -1;
  const Material* listed = nullptr;  // the last one that the scene lists; null: none
};

struct AreaLightSpec {
  std::string name;
  ParamSet params;
};

struct GraphicsState {
  MovingTransform transform;
  ActiveTimes active = ActiveTimes::All;
  bool reverseOrientation = false;
  std::shared_ptr<MaterialSpec> material;
  std::shared_ptr<const AreaLightSpec> areaLight;  // null: shapes do not emit
  std::shared_ptr<TextureTable> textures = std::make_shared<TextureTable>();
  std::shared_ptr<MaterialMap> namedMaterials = std::make_shared<MaterialMap>();

  // Return a table that may be changed. A table that other states share is copied first.
  TextureTable& OwnTextures();
  MaterialMap& OwnNamedMaterials();
};

// StateStack holds the open blocks, each with its start and the state that its end restores.
class StateStack {
 public:
  enum class Block { Attribute, Transform, Object };
  static constexpr std::size_t kMaxDepth = 4096;

  void Push(Block block, const GraphicsState& state, const SourceLocation& where);
  // Closes the innermost block, which must be of this kind. `name` is the directive's name.
  void Pop(Block block, const std::string& name, const SourceLocation& where, GraphicsState* state);

  // Closes the innermost block of this kind and all blocks in it. Returns false, and changes
  // nothing, if there is none.
  bool PopThrough(Block block, GraphicsState* state);

  bool IsEmpty() const { return entries_.empty(); }
  bool Has(Block block) const;
  const SourceLocation& Innermost() const { return entries_.back().where; }
  const char* InnermostName() const;
  void Clear() { entries_.clear(); }

 private:
  struct Entry {
    Block block;
    GraphicsState state;
    SourceLocation where;
  };
  std::vector<Entry> entries_;
};

// Returns "scene.pbrt:12", for use within a message.
std::string LocationText(const SourceLocation& where);

[[noreturn]] void FailAt(const SourceLocation& where, const std::string& text,
                         const std::string& hint = {});
// The same with a DependentError.
[[noreturn]] void FailDependent(const SourceLocation& where, const std::string& text,
                                const std::string& hint = {});

}  // namespace exphoton
