// SPDX-License-Identifier: BSD-2-Clause
// TextureTable finds textures by name. Sums of texture graph sizes saturate instead of overflowing.
#include "core/parser/builder/texture_table.h"

#include <algorithm>

#include "core/params/suggestions.h"

namespace exphoton {
namespace {

constexpr std::int64_t kMaxNodes = std::int64_t(1) << 60;

template <class Map>
auto TextureIn(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? decltype(found->second.texture)() : found->second.texture;
}

template <class Map>
TextureGraph GraphIn(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? TextureGraph() : found->second.graph;
}

template <class Map>
void CopyEntry(const Map& from, const std::string& name, Map* to) {
  const auto found = from.find(name);
  if (found != from.end()) to->insert(*found);
}

}  // namespace

void TextureGraph::Include(const TextureGraph& other) {
  depth = std::max(depth, other.depth);
  nodes = std::min(nodes + other.nodes, kMaxNodes);
}

TexturePtr<Real> TextureTable::Float(const std::string& name) const {
  TexturePtr<Real> texture = TextureIn(float_, name);
  return texture || !acceptsAllNames_ ? texture : Uniform(Real(0));
}
TexturePtr<Spectrum> TextureTable::Color(const std::string& name) const {
  TexturePtr<Spectrum> texture = TextureIn(color_, name);
  return texture || !acceptsAllNames_ ? texture : Uniform(Spectrum());
}

std::vector<std::string> TextureTable::Names() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : float_) names.push_back(name);
  for (const auto& [name, entry] : color_)
    if (!float_.contains(name)) names.push_back(name);
  return names;
}

bool TextureTable::Has(const std::string& name, bool isColor) const {
  return isColor ? color_.contains(name) : float_.contains(name);
}

TextureGraph TextureTable::Graph(const std::string& name, bool isColor) const {
  return isColor ? GraphIn(color_, name) : GraphIn(float_, name);
}

void TextureTable::Define(const std::string& name, TexturePtr<Real> texture,
                          const TextureGraph& graph) {
  float_[name] = {std::move(texture), graph};
}
void TextureTable::Define(const std::string& name, TexturePtr<Spectrum> texture,
                          const TextureGraph& graph) {
  color_[name] = {std::move(texture), graph};
}

TextureTable TextureTable::Only(const std::vector<std::string>& names) const {
  TextureTable some;
  some.generation = generation;
  some.acceptsAllNames_ = acceptsAllNames_;
  for (const std::string& name : names) {
    const bool isKnown = Has(name, false) || Has(name, true);
    const std::string kept = isKnown ? name : Nearest(name, Names()).value_or(name);
    CopyEntry(float_, kept, &some.float_);
    CopyEntry(color_, kept, &some.color_);
  }
  return some;
}

TextureGraph TextureUse::Above() const {
  TextureGraph graph = used_;
  ++graph.depth;
  graph.Include({0, 1});
  return graph;
}

}  // namespace exphoton
