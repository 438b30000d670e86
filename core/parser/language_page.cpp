// SPDX-License-Identifier: BSD-2-Clause
// The data of pbrt's plugins is compared with the parameter tables of the plugins that are
// available here.
#include "core/parser/language_page.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include "core/parser/builder/missing_renderers.h"
#include "core/parser/film_parameters.h"
#include "core/parser/pbrt_parameters.h"  // generated from pbrt_parameters.txt
#include "core/parser/reference/strip_sections.h"
#include "core/plugins/catalogue.h"
#include "core/plugins/substitute_params.h"

namespace exphoton {
namespace {

struct LanguageSection {
  const char *kind, *title;
  std::optional<PluginKind> plugins;  // absent: the core itself handles this kind
};
constexpr LanguageSection kSections[] = {
    {"integrator", "Surface integrators", PluginKind::Integrator},
    {"volumeintegrator", "Volume integrators", PluginKind::VolumeIntegrator},
    {"renderer", "Renderers", std::nullopt},
    {"accelerator", "Accelerators", PluginKind::Accelerator},
    {"camera", "Cameras", PluginKind::Camera},
    {"film", "Films", std::nullopt},
    {"filter", "Pixel filters", PluginKind::Filter},
    {"sampler", "Samplers", PluginKind::Sampler},
    {"shape", "Shapes", PluginKind::Shape},
    {"light", "Lights", PluginKind::Light},
    {"arealight", "Area lights", PluginKind::AreaLight},
    {"material", "Materials", PluginKind::Material},
    {"texture", "Textures of floats and colors", PluginKind::ColorTexture},
    {"colortexture", "Textures of colors", PluginKind::ColorTexture},
    {"volume", "Volumes", PluginKind::Volume},
};

// A parameter's versions follow a colon; without one they are those of its plugin.
PbrtPlugin::Parameter ParameterOf(const std::string& word, const std::string& versions) {
  const std::size_t colon = word.find(':');
  if (colon == std::string::npos) return {word, versions};
  return {word.substr(0, colon), word.substr(colon + 1)};
}

std::vector<PbrtPlugin> ParsePlugins(const char* text) {
  std::vector<PbrtPlugin> plugins;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    if (line[0] != ' ') {
      PbrtPlugin& plugin = plugins.emplace_back();
      words >> plugin.versions >> plugin.kind >> plugin.name;
      plugin.name.pop_back();  // the colon
    }
    PbrtPlugin& plugin = plugins.back();
    for (std::string word; words >> word;)
      plugin.parameters.push_back(ParameterOf(word, plugin.versions));
  }
  return plugins;
}

// What becomes of a plugin here. Each list of parameters that have an effect may be null.
struct Fate {
  std::string text;
  const std::vector<ParamDecl>* declared;             // by the plugin
  const std::vector<ParamDecl>* converted = nullptr;  // to parameters of its substitute
};

Fate FateOfRenderer(const PbrtPlugin& plugin) {
  for (const MissingRenderer& missing : kMissingRenderers) {
    if (plugin.name != missing.name) continue;
    const std::string by = missing.integrator
                               ? "integrator `" + std::string(missing.integrator) + '`'
                               : std::string("the scene's integrator");
    return {"replaced by " + by + ": " + missing.loss, nullptr};
  }
  return {"available", nullptr};
}

Fate FateOfPlugin(const PbrtPlugin& plugin, const LanguageSection& section,
                  PluginRegistry& registry) {
  if (plugin.kind == "film") return {"available", &FilmParameterTable().Declarations()};
  if (!section.plugins) return FateOfRenderer(plugin);
  const PluginKind kind = *section.plugins;
  const std::vector<std::string> available = registry.Available(kind);
  const bool isAvailable =
      std::find(available.begin(), available.end(), plugin.name) != available.end();
  const PluginAlias* const alias = FindPluginAlias(kind, plugin.name);
  if (!isAvailable && !alias) return {"not available", nullptr};
  const std::string name = isAvailable ? plugin.name : alias->name;
  const auto* const declared = &registry.Find(kind, name, {}).parameters->Declarations();
  if (isAvailable) return {"available", declared};
  if (!alias->loss) return {"available, as `" + name + '`', declared};
  return {"replaced by `" + name + "`: " + alias->loss, declared,
          ConvertedParameters(kind, plugin.name)};
}

bool HasEffect(const PbrtPlugin& plugin, const std::string& parameter, const Fate& fate) {
  if (plugin.name == "metropolis" && parameter == "maxdepth") return true;
  const auto has = [&](const std::vector<ParamDecl>* list) {
    return list && std::any_of(list->begin(), list->end(), [&](const ParamDecl& decl) {
             return decl.name == parameter && !decl.isIgnored;
           });
  };
  return has(fate.declared) || has(fate.converted);
}

std::string VersionsText(const std::string& versions) {
  return versions == "12" ? "1, 2" : versions;
}

std::string RowOf(const PbrtPlugin& plugin, const Fate& fate) {
  std::string columns[2];  // with effect, ignored
  for (const PbrtPlugin::Parameter& parameter : plugin.parameters) {
    std::string& column = columns[HasEffect(plugin, parameter.name, fate) ? 0 : 1];
    column += (column.empty() ? "`" : ", `") + parameter.name + '`';
    if (parameter.versions != plugin.versions) column += " (" + parameter.versions + ')';
  }
  return "| `" + plugin.name + "` | " + VersionsText(plugin.versions) + " | " + fate.text + " | " +
         columns[0] + " | " + columns[1] + " |\n";
}

constexpr const char* kLanguageFile = "pbrt.md";

}  // namespace

const std::vector<PbrtPlugin>& PbrtPlugins() {
  static const std::vector<PbrtPlugin> plugins = ParsePlugins(kPbrtParameters);
  return plugins;
}

std::string LanguagePage(PluginRegistry& registry) {
  std::string text =
      "<!-- Generated from the plugins' own declarations by `exphoton plugins --write-reference`. "
      "-->\n\n"
      "# The plugins and parameters of pbrt, versions 1 and 2\n\n"
      "This page is for users who have scenes of pbrt. It lists every plugin and parameter of\n"
      "versions 1 and 2. A plugin is available, or another one replaces it with a warning that\n"
      "`--strict` turns into an error. A number in brackets is the only version that has a\n"
      "parameter. Ignored parameters have no effect on the picture, or belong to a plugin that is\n"
      "replaced.\n";
  for (const LanguageSection& section : kSections) {
    text += "\n## " + std::string(section.title) +
            "\n\n| plugin | versions | here | parameters | ignored |\n"
            "| --- | --- | --- | --- | --- |\n";
    for (const PbrtPlugin& plugin : PbrtPlugins())
      if (plugin.kind == section.kind)
        text += RowOf(plugin, FateOfPlugin(plugin, section, registry));
  }
  return text;
}

std::map<std::string, std::string> AllReferencePages(PluginRegistry& registry) {
  auto pages = ReferencePages(registry);
  pages[kLanguageFile] = LanguagePage(registry);
  std::string& materials = pages["materials.md"];
  materials.insert(materials.find("## "),
                   "![One object in every "
                   "material](../../scenes/material-gallery/images/labelled.jpg)\n\n");
  AddParameterStrips(registry, &pages);
  pages["README.md"] +=
      "- [The plugins and parameters of pbrt](pbrt.md), and what becomes of them\n\n"
      "![Shapes, materials, textures and lights](../../scenes/language-tour/images/sheet.jpg)\n";
  return pages;
}

}  // namespace exphoton
