// SPDX-License-Identifier: BSD-2-Clause
// TextureTable: the textures that a scene has defined so far, with the size of the graph below
// each. TextureUse: which of them a directive refers to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/params/param_set.h"

namespace exphoton {

// What one lookup of a texture may evaluate. A texture that is used twice counts twice, as it is
// evaluated twice.
struct TextureGraph {
  int depth = 0;           // textures on the longest way down
  std::int64_t nodes = 0;  // textures in all; sums saturate

  void Include(const TextureGraph& other);
};

// Deeper graphs could overflow the stack of a thread: each texture evaluates those that it uses.
inline constexpr int kMaxTextureDepth = 256;

// Shared by graphics states until one of them defines another texture.
class TextureTable final : public TextureLookup {
 public:
  TexturePtr<Real> Float(const std::string& name) const override;
  TexturePtr<Spectrum> Color(const std::string& name) const override;
  std::vector<std::string> Names() const override;
  bool Has(const std::string& name, bool isColor) const;
  // Empty where there is no such texture.
  TextureGraph Graph(const std::string& name, bool isColor) const;

  void Define(const std::string& name, TexturePtr<Real> texture, const TextureGraph& graph);
  void Define(const std::string& name, TexturePtr<Spectrum> texture, const TextureGraph& graph);

  // Changes when a name gets another meaning: materials made before are then made anew.
  int generation = 0;

 private:
  template <class T>
  struct Entry {
    TexturePtr<T> texture;
    TextureGraph graph;
  };
  std::map<std::string, Entry<Real>> float_;
  std::map<std::string, Entry<Spectrum>> color_;
};

// Finds textures in a table, and adds up the graphs of the textures found.
class TextureUse final : public TextureLookup {
 public:
  explicit TextureUse(const TextureTable& table) : table_(table) {}

  TexturePtr<Real> Float(const std::string& name) const override {
    used_.Include(table_.Graph(name, false));
    return table_.Float(name);
  }
  TexturePtr<Spectrum> Color(const std::string& name) const override {
    used_.Include(table_.Graph(name, true));
    return table_.Color(name);
  }
  std::vector<std::string> Names() const override { return table_.Names(); }

  // The graph of a texture that evaluates each of the found ones once.
  TextureGraph Above() const;

 private:
  const TextureTable& table_;
  mutable TextureGraph used_;
};

}  // namespace exphoton
