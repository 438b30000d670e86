// SPDX-License-Identifier: BSD-2-Clause
// LaterState is the graphics state of a scene of version 3 or 4, as far as the conversion needs it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/math/transform.h"
#include "core/parser/syntax/directive.h"

namespace exphoton::cli {

class LaterState {
 public:
  // Takes transformations, blocks, the camera and Attribute into account; ignores the rest. Throws
  // Error(Scene) for blocks that do not match and for matrices without inverse.
  void Handle(const Directive& directive);

  // Returns the directive with the parameters that Attribute "shape" and the like give in advance.
  Directive WithAttributes(Directive directive, const std::string& target) const;

  const Transform& Current() const { return now_.transform; }
  std::size_t Depth() const { return saved_.size(); }
  // Throws Error(Scene) if a block is open.
  void CheckEnd(const SourceLocation& where) const;

  bool IsHidden() const { return now_.isHidden; }  // the material only bounds media
  void SetHidden(bool isHidden) { now_.isHidden = isHidden; }
  bool Emits() const { return now_.emits; }  // an area light is attached to shapes
  void SetEmits(bool emits) { now_.emits = emits; }

  // The named materials of version 3 end with the block.
  void NameMaterial(const std::string& name, const Directive& definition);
  const Directive* FindMaterial(const std::string& name) const;  // null if unknown
  std::vector<std::string> MaterialNames() const;

 private:
  struct Values {
    Transform transform;
    bool isActive = true;  // transformations change the matrix of the start time
    bool isHidden = false, emits = false;
    std::map<std::string, std::vector<ParsedParam>> attributes;
    std::size_t materials = 0;  // number of named materials that exist
  };
  struct Saved {
    DirectiveId begin;
    Values values;
  };

  void HandleBlock(const Directive& directive);
  void End(DirectiveId begin, const Directive& directive);

  Values now_;
  std::vector<Saved> saved_;
  std::map<std::string, Transform> coordinates_;
  std::vector<std::pair<std::string, Directive>> materials_;
};

}  // namespace exphoton::cli
