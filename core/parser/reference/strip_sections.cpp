// SPDX-License-Identifier: BSD-2-Clause
#include "core/parser/reference/strip_sections.h"

#include <algorithm>
#include <iterator>
#include <vector>

#include "core/base/terminal.h"
#include "core/parser/reference/parameter_strips.h"

namespace exphoton {
namespace {

constexpr int kLinkColumns = 96;

struct Plugin {
  PluginKind kind;
  std::string name;

  bool Has(const ParameterStrip& strip) const { return strip.kind == kind && strip.plugin == name; }
};

// Returns the parameters in the order of their table on the page: basic ones first.
std::vector<ParamDecl> ParametersOf(PluginRegistry& registry, const Plugin& plugin) {
  std::vector<ParamDecl> result =
      registry.Find(plugin.kind, plugin.name, {}).parameters->Declarations();
  std::stable_partition(result.begin(), result.end(),
                        [](const ParamDecl& decl) { return decl.isBasic; });
  return result;
}

std::string HeadingOf(const Plugin& plugin) {
  std::string kind = PluginKindName(plugin.kind);
  kind[0] = char(kind[0] - 'a' + 'A');
  return kind + " `" + plugin.name + '`';
}

// Returns "material-matte", the name by which links refer to the heading.
std::string AnchorOf(const Plugin& plugin) {
  std::string text = PluginKindName(plugin.kind) + ('-' + plugin.name);
  std::replace(text.begin(), text.end(), ' ', '-');
  return text;
}

// Returns the values of a strip with commas or semicolons between them.
std::string Listed(const std::string& values) {
  if (values.find(';') != std::string::npos) return values;
  std::string text;
  for (const char c : values) text += c == ' ' ? ", " : std::string(1, c);
  return text;
}

std::string PictureOf(const ParameterStrip& strip) {
  return std::string("\n`") + strip.parameter + "` " + Listed(strip.values) + ":\n\n![" +
         strip.plugin + ": " + strip.parameter + "](images/" + strip.Name() + ".jpg)\n";
}

// Returns whether the strip shows a parameter with the name and the meaning of `decl`.
bool Shows(PluginRegistry& registry, const ParameterStrip& strip, const ParamDecl& decl) {
  if (strip.parameter != decl.name) return false;
  const auto parameters = ParametersOf(registry, {strip.kind, strip.plugin});
  return std::any_of(parameters.begin(), parameters.end(), [&](const ParamDecl& other) {
    return other.name == decl.name && other.doc == decl.doc;
  });
}

// The parameters of a plugin that the strips of one other plugin show.
struct Link {
  Plugin plugin;
  std::string parameters;
};

void AddToLinks(const ParameterStrip& strip, std::vector<Link>* links) {
  auto link = std::find_if(links->begin(), links->end(),
                           [&](const Link& other) { return other.plugin.Has(strip); });
  if (link == links->end()) {
    links->push_back(Link{Plugin{strip.kind, strip.plugin}, ""});
    link = std::prev(links->end());
  }
  link->parameters += (link->parameters.empty() ? "`" : ", `") + std::string(strip.parameter) + '`';
}

// Returns the end of the plugin's section: its pictures, and links to the pictures of others.
std::string SectionEnd(PluginRegistry& registry, const Plugin& plugin, const std::string& page) {
  const auto strips = ParameterStrips();
  std::string pictures, text;
  std::vector<Link> links;
  for (const ParamDecl& decl : ParametersOf(registry, plugin)) {
    if (decl.isIgnored) continue;
    auto strip = std::find_if(strips.begin(), strips.end(), [&](const ParameterStrip& other) {
      return plugin.Has(other) && other.parameter == decl.name;
    });
    if (strip != strips.end()) {
      pictures += PictureOf(*strip);
      continue;
    }
    // A plugin of the same name and another kind comes first, such as a texture of colours.
    const auto showing = [&](bool needsName) {
      return std::find_if(strips.begin(), strips.end(), [&](const ParameterStrip& other) {
        return other.Page() == page && (!needsName || other.plugin == plugin.name) &&
               Shows(registry, other, decl);
      });
    };
    strip = showing(true);
    if (strip == strips.end()) strip = showing(false);
    if (strip != strips.end()) AddToLinks(*strip, &links);
  }
  for (const Link& link : links)
    text += '[' + HeadingOf(link.plugin) + "](#" + AnchorOf(link.plugin) + ") shows " +
            link.parameters + ". ";
  return text.empty() ? pictures : pictures + '\n' + WrappedText(text, 0, kLinkColumns);
}

}  // namespace

void AddParameterStrips(PluginRegistry& registry, std::map<std::string, std::string>* pages) {
  for (int i = 0; i < kPluginKindCount; ++i) {
    const auto kind = static_cast<PluginKind>(i);
    const std::string file = std::string(PluginKindFolder(kind)) + ".md";
    std::string& page = pages->at(file);
    for (const std::string& name : registry.Available(kind)) {
      const Plugin plugin{kind, name};
      const std::size_t begin = page.find("## " + HeadingOf(plugin) + '\n');
      const std::size_t end = std::min(page.find("\n## ", begin), page.size());
      page.insert(end, SectionEnd(registry, plugin, file));
    }
  }
}

}  // namespace exphoton
