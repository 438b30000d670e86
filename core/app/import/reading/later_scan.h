// SPDX-License-Identifier: BSD-2-Clause
// LaterScan reads a scene once before it is converted. It finds the version, and the textures and
// named materials of version 4, which may be used before and outside of the block that has them.
#pragma once

#include <optional>
#include <utility>

#include "core/app/import/reading/later_reader.h"

namespace exphoton::cli {

struct PlacedTexture {
  Directive directive;
  Transform transform;
};

class LaterScan final : public LaterReader {
 public:
  using LaterReader::LaterReader;

  int Version() const { return isOf4_ || !hasWorldEnd_ ? 4 : 3; }
  bool HasMix() const { return hasMix_; }
  const std::vector<PlacedTexture>& Textures() const { return textures_; }
  // By name, in the order of the file.
  const std::vector<std::pair<std::string, Directive>>& Materials() const { return materials_; }

 protected:
  void Visit(const Directive& directive) override;
  void End(const SourceLocation& end) override;

 private:
  bool isOf4_ = false, hasWorldEnd_ = false, hasWorld_ = false, hasMix_ = false;
  std::vector<PlacedTexture> textures_;
  std::vector<std::pair<std::string, Directive>> materials_;
};

// Returns the class of a material that MakeNamedMaterial defines. Throws Error(Scene) without one.
std::string NamedMaterialType(const Directive& directive);

}  // namespace exphoton::cli
