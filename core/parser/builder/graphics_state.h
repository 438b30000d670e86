// SPDX-License-Identifier: BSD-2-Clause
// What AttributeBegin saves and AttributeEnd brings back: transformation, material, area light,
// orientation and the names known so far. Cheap to copy.
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

// A Material directive. The object is made when a shape first wears it, with the textures known
// there; later shapes share it.
struct MaterialSpec {
  std::string name;
  ParamSet params;
  std::shared_ptr<const TextureTable> textures;  // null: those known at the shape

  std::shared_ptr<const Material> made;
  int madeGeneration = -1;
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
  std::shared_ptr<const AreaLightSpec> areaLight;  // null: shapes emit nothing
  std::shared_ptr<TextureTable> textures = std::make_shared<TextureTable>();
  using MaterialMap = std::map<std::string, std::shared_ptr<MaterialSpec>>;
  std::shared_ptr<MaterialMap> namedMaterials = std::make_shared<MaterialMap>();

  // To be called before a change of what other states may share.
  TextureTable& OwnTextures();
  MaterialMap& OwnNamedMaterials();
};

// The open blocks. Each remembers the state it brings back and where it began.
class StateStack {
 public:
  enum class Block { Attribute, Transform, Object };
  static constexpr std::size_t kMaxDepth = 4096;

  void Push(Block block, const GraphicsState& state, const SourceLocation& where);
  // Closes the innermost block, which must be of that kind; `name` is the directive's.
  void Pop(Block block, const std::string& name, const SourceLocation& where, GraphicsState* state);

  bool IsEmpty() const { return entries_.empty(); }
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

// "scene.pbrt:12", for use within a message.
std::string PlaceName(const SourceLocation& where);

[[noreturn]] void FailAt(const SourceLocation& where, const std::string& text,
                         const std::string& hint = {});

}  // namespace exphoton
