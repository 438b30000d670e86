// SPDX-License-Identifier: BSD-2-Clause
// TextureTable holds the textures that a scene has defined so far, with the size of the graph below
// each. TextureUse records the textures that one directive refers to.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/params/param_set.h"

namespace exphoton {

// TextureGraph measures the work of one texture lookup. A texture that is referenced twice counts
// twice, because it is evaluated twice.
struct TextureGraph {
  int depth = 0;           // number of textures on the longest path
  std::int64_t nodes = 0;  // total number of textures; sums saturate

  void Include(const TextureGraph& other);
};

// Deeper graphs could overflow a thread's stack, because texture evaluation is recursive.
inline constexpr int kMaxTextureDepth = 256;

// Graphics states share a table until one of them defines another texture.
class TextureTable final : public TextureLookup {
 public:
  TexturePtr<Real> Float(const std::string& name) const override;
  TexturePtr<Spectrum> Color(const std::string& name) const override;
  std::vector<std::string> Names() const override;
  bool Has(const std::string& name, bool isColor) const;
  // Returns an empty graph if there is no such texture.
  TextureGraph Graph(const std::string& name, bool isColor) const;

  void Define(const std::string& name, TexturePtr<Real> texture, const TextureGraph& graph);
  void Define(const std::string& name, TexturePtr<Spectrum> texture, const TextureGraph& graph);

  // Returns a table of the textures with these names. In the place of a name that is not defined it
  // has the texture with the nearest name, so that messages can suggest it.
  TextureTable Only(const std::vector<std::string>& names) const;

  // Makes Float and Color return black for names that are not defined: the file may define them in
  // text that cannot be read.
  void AcceptAllNames() { acceptsAllNames_ = true; }

  // Different for any two tables with different textures. Materials made from another generation
  // are remade.
  int generation = 0;

 private:
  template <class T>
  struct Entry {
    TexturePtr<T> texture;
    TextureGraph graph;
  };
  std::map<std::string, Entry<Real>> float_;
  std::map<std::string, Entry<Spectrum>> color_;
  bool acceptsAllNames_ = false;
};

// Looks up textures in a table and sums the graphs of the textures found.
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

  // Returns the graph of a texture that evaluates each texture found once.
  TextureGraph Above() const;

 private:
  const TextureTable& table_;
  mutable TextureGraph used_;
};

}  // namespace exphoton
