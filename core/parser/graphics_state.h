// SPDX-License-Identifier: BSD-2-Clause
// What AttributeBegin saves and AttributeEnd brings back: transformation, material, area light,
// orientation and the names known so far. Cheap to copy.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/params/param_set.h"
#include "core/parser/moving_transform.h"
#include "core/scattering/material.h"

namespace exphoton {

// The textures defined so far. Shared by states until one of them defines another.
class TextureTable final : public TextureLookup {
 public:
  TexturePtr<Real> Float(const std::string& name) const override;
  TexturePtr<Spectrum> Color(const std::string& name) const override;
  std::vector<std::string> Names() const override;
  bool Has(const std::string& name, bool isColor) const;

  void Define(const std::string& name, TexturePtr<Real> texture);
  void Define(const std::string& name, TexturePtr<Spectrum> texture);

  // Changes when a name gets another meaning: materials made before are then made anew.
  int generation = 0;

 private:
  std::map<std::string, TexturePtr<Real>> float_;
  std::map<std::string, TexturePtr<Spectrum>> color_;
};

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
