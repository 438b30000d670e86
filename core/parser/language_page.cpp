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
#include "core/plugins/catalogue.h"

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

// What becomes of a plugin here. `declared` is null if no parameter has an effect.
struct Fate {
  std::string text;
  const std::vector<ParamDecl>* declared;
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
  return {"replaced by `" + name + "`: " + alias->loss, declared};
}

bool HasEffect(const PbrtPlugin& plugin, const std::string& parameter, const Fate& fate) {
  if (plugin.name == "metropolis" && parameter == "maxdepth") return true;
  return fate.declared &&
         std::any_of(fate.declared->begin(), fate.declared->end(), [&](const ParamDecl& decl) {
           return decl.name == parameter && !decl.isIgnored;
         });
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

std::string WithCommas(const std::string& values) {
  std::string text;
  for (const char c : values) text += c == ' ' ? ", " : std::string(1, c);
  return text;
}

// Appends the strip to the section of its plugin.
void AddStrip(const ParameterStrip& strip, std::string* page) {
  const std::string heading = std::string("## ") + strip.kind + " `" + strip.plugin + "`\n",
                    values = WithCommas(strip.values);
  const std::size_t end = page->find("\n## ", page->find(heading) + 1);
  page->insert(std::min(end, page->size()), std::string("\n`") + strip.parameter + "` " + values +
                                                ":\n\n![" + strip.plugin + ": " + strip.parameter +
                                                ' ' + values + "](images/" + strip.plugin + '-' +
                                                strip.parameter + ".jpg)\n");
}

}  // namespace

const std::vector<PbrtPlugin>& PbrtPlugins() {
  static const std::vector<PbrtPlugin> plugins = ParsePlugins(kPbrtParameters);
  return plugins;
}

const std::vector<ParameterStrip>& ParameterStrips() {
  static const std::vector<ParameterStrip> strips{
      {"materials.md", "Material", "matte", "sigma", "0 15 30 50 80"},
      {"materials.md", "Material", "matte", "bumpmap", "0 .05 .1 .2 .4"},
      {"materials.md", "Material", "metal", "roughness", ".002 .01 .05 .15 .5"},
      {"materials.md", "Material", "shinymetal", "roughness", ".002 .01 .05 .15 .5"},
      {"materials.md", "Material", "plastic", "roughness", ".002 .01 .05 .15 .5"},
      {"materials.md", "Material", "plastic", "Ks", "0 .1 .3 .6 1"},
      {"materials.md", "Material", "substrate", "uroughness", ".005 .02 .05 .2 .8"},
      {"materials.md", "Material", "translucent", "transmit", "0 .25 .5 .75 1"},
      {"materials.md", "Material", "uber", "opacity", "1 .75 .5 .25 .05"},
      {"materials.md", "Material", "glass", "index", "1.02 1.1 1.33 1.5 2.4"},
      {"materials.md", "Material", "mix", "amount", "0 .25 .5 .75 1"},
      {"textures.md", "Float texture", "fbm", "octaves", "1 2 3 5 8"},
      {"textures.md", "Float texture", "fbm", "roughness", ".2 .3 .4 .5 .6"},
      {"textures.md", "Float texture", "wrinkled", "octaves", "1 2 3 5 8"},
      {"textures.md", "Float texture", "wrinkled", "roughness", ".2 .3 .4 .5 .6"},
      {"textures.md", "Color texture", "marble", "variation", "0 .1 .2 .5 1"},
      {"textures.md", "Color texture", "marble", "scale", ".5 1 2 4 8"},
      {"textures.md", "Color texture", "checkerboard", "uscale", "1 2 4 8 16"},
      {"textures.md", "Color texture", "checkerboard", "aamode", "closedform supersample none"},
      {"textures.md", "Color texture", "dots", "uscale", "2 4 8 16 32"},
      {"textures.md", "Color texture", "imagemap", "mapping", "uv spherical cylindrical planar"},
      {"textures.md", "Color texture", "imagemap", "wrap", "repeat black clamp"},
      {"textures.md", "Color texture", "imagemap", "gamma", ".5 1 1.5 2.2 3"},
      {"filters.md", "Filter", "box", "xwidth", ".25 .5 1 2 4"},
      {"filters.md", "Filter", "triangle", "xwidth", ".5 1 2 3 4"},
      {"filters.md", "Filter", "gaussian", "alpha", "8 4 2 1 .3"},
      {"filters.md", "Filter", "mitchell", "B", "0 .25 .5 .75 1"},
      {"filters.md", "Filter", "mitchell", "C", "0 .25 .5 .75 1"},
      {"filters.md", "Filter", "sinc", "tau", ".5 1 2 3 6"},
      {"cameras.md", "Camera", "perspective", "fov", "15 30 45 70 100"},
      {"cameras.md", "Camera", "perspective", "lensradius", "0 .05 .1 .2 .4"},
      {"cameras.md", "Camera", "perspective", "focaldistance", "3 4 5.7 8 20"},
      {"cameras.md", "Camera", "perspective", "shutterclose", "0 .1 .3 .6 1"},
      {"volumes.md", "Volume", "homogeneous", "sigma_s", "0 .02 .05 .1 .2"},
      {"volumes.md", "Volume", "homogeneous", "sigma_a", "0 .05 .1 .2 .4"},
      {"volumes.md", "Volume", "homogeneous", "g", "-.7 -.35 0 .35 .7"},
      {"volumes.md", "Volume", "exponential", "b", "0 .5 1 2 4"},
      {"lights.md", "Light", "spot", "coneangle", "8 14 20 30 50"},
      {"lights.md", "Light", "spot", "conedeltaangle", "0 4 8 14 20"},
      {"shapes.md", "Shape", "loopsubdiv", "nlevels", "0 1 2 3 4"},
  };
  return strips;
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
  for (const ParameterStrip& strip : ParameterStrips()) AddStrip(strip, &pages[strip.page]);
  pages["README.md"] +=
      "- [The plugins and parameters of pbrt](pbrt.md), and what becomes of them\n\n"
      "![Shapes, materials, textures and lights](../../scenes/language-tour/images/sheet.jpg)\n";
  return pages;
}

}  // namespace exphoton
