// SPDX-License-Identifier: BSD-2-Clause
// ReadRgb reads spectra as the renderer does, and knows the names of common spectra of version 4.
#include "core/app/import/reading/later_color.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/math/cie.h"
#include "core/params/param_reader.h"
#include "core/params/scene_path.h"

namespace exphoton::cli {
namespace {

struct NamedColor {
  std::string_view name;
  Rgb rgb;
};

// Indices and absorption coefficients of metals in linear RGB, as other renderers publish them.
constexpr std::array<NamedColor, 8> kMetals{{
    {"metal-Cu-eta", {.200438, .924033, 1.102212}},
    {"metal-Cu-k", {3.912949, 2.452848, 2.142188}},
    {"metal-Au-eta", {.143119, .374957, 1.442479}},
    {"metal-Au-k", {3.98316, 2.385721, 1.603215}},
    {"metal-Ag-eta", {.155265, .116723, .138381}},
    {"metal-Ag-k", {4.828343, 3.122225, 2.147042}},
    {"metal-Al-eta", {1.65746, .880369, .521229}},
    {"metal-Al-k", {9.22387, 6.269523, 4.837001}},
}};
// Indices at 587.6 nm, from the makers' data sheets. The F5, F10 and F11 of version 4 are the
// glasses SF5, SF10 and SF11.
constexpr std::array<std::pair<std::string_view, double>, 7> kGlasses{{
    {"glass-BK7", 1.5168},
    {"glass-BAF10", 1.67003},
    {"glass-FK51A", 1.48656},
    {"glass-LASF9", 1.85025},
    {"glass-F5", 1.6727},
    {"glass-F10", 1.72825},
    {"glass-F11", 1.78472},
}};
// Chromaticities x, y of the CIE's illuminants.
struct Illuminant {
  std::string_view name;
  double x, y;
};
constexpr std::array<Illuminant, 6> kIlluminants{{
    {"stdillum-A", .44757, .40745},
    {"stdillum-D50", .34567, .3585},
    {"stdillum-F2", .37208, .37529},
    {"stdillum-F7", .31292, .32933},
    {"stdillum-F11", .38052, .37713},
    {"illum-acesD60", .32168, .33767},
}};

Rgb RgbOf(const Spectrum& s) {
  return {std::max(0., double(s.r)), std::max(0., double(s.g)), std::max(0., double(s.b))};
}

double Luminance(const Rgb& c) { return .212671 * c[0] + .71516 * c[1] + .072169 * c[2]; }

std::optional<Rgb> FindName(const std::string& name) {
  if (name == "stdillum-D65") return Rgb{1, 1, 1};
  for (const NamedColor& metal : kMetals)
    if (metal.name == name) return metal.rgb;
  for (const auto& [glass, index] : kGlasses)
    if (glass == name) return Rgb{index, index, index};
  for (const Illuminant& light : kIlluminants)
    if (light.name == name)
      return RgbOf(RgbFromXyz(light.x / light.y, 1, (1 - light.x - light.y) / light.y));
  return {};
}

// Reads a colour in a notation of version 2.
Rgb ReadAsVersion2(const ParsedParam& param, const ImportContext& context) {
  ParamDecl declaration;
  declaration.name = param.name;
  declaration.type = ParamType::Color;
  BindContext binding;
  binding.what = "version " + std::to_string(context.version);
  return RgbOf(std::any_cast<Spectrum>(ParamReader(declaration, param, binding).Read()));
}

Rgb ReadSpectrum(const ParsedParam& param, const Rgb& fallback, const ImportContext& context) {
  if (param.strings.empty()) return ReadAsVersion2(param, context);
  if (const auto found = FindName(param.strings[0])) return *found;
  if (std::filesystem::exists(ResolveScenePath(param.strings[0], param.where)))
    return ReadAsVersion2(param, context);
  context.report.Replaced("the spectrum \"" + param.strings[0] +
                              "\" is not known: the default of \"" + param.name +
                              "\" takes its place",
                          param.where);
  return fallback;
}

Rgb BlackbodyOf(const ParsedParam& param) {
  // Version 3 gives a scale, too.
  const bool isValid = !param.numbers.empty() && param.numbers.size() <= 2 &&
                       param.numbers[0] > 0 && param.numbers[0] <= 1e9;
  if (!isValid)
    throw Error(ExitStatus::Scene,
                "parameter \"" + param.name + "\" takes a temperature in kelvin above 0",
                param.where);
  Rgb rgb = RgbOf(RgbOfBlackbody(param.numbers[0]));
  for (double& value : rgb) value *= param.numbers.size() == 2 ? param.numbers[1] : 1;
  return rgb;
}

}  // namespace

Rgb ReadRgb(const ParsedParam& param, const Rgb& fallback, ColorUse use,
            const ImportContext& context) {
  if ((param.type == "rgb" || param.type == "color") && param.numbers.size() == 3)
    return {param.numbers[0], param.numbers[1], param.numbers[2]};
  if ((param.type == "float" || param.type == "integer") && param.numbers.size() == 1)
    return {param.numbers[0], param.numbers[0], param.numbers[0]};
  Rgb rgb = param.type == "blackbody"  ? BlackbodyOf(param)
            : param.type == "spectrum" ? ReadSpectrum(param, fallback, context)
                                       : ReadAsVersion2(param, context);
  const double luminance = Luminance(rgb);
  if (use == ColorUse::Light && context.version == 4 && luminance > 0)
    for (double& value : rgb) value /= luminance;
  return rgb;
}

double ReadIndex(const ParsedParam& param, double fallback, const LaterParams& params,
                 const ImportContext& context) {
  if (param.type == "texture") {
    params.Replaced(param, "is a texture: " + ExactText(fallback) + " takes its place");
    return fallback;
  }
  if (param.numbers.size() == 1) return param.numbers[0];
  const Rgb rgb = ReadRgb(param, {fallback, fallback, fallback}, ColorUse::Material, context);
  return (rgb[0] + rgb[1] + rgb[2]) / 3;
}

std::vector<double> NumbersOf(const Rgb& color) { return {color.begin(), color.end()}; }

void AddColor(const ColorNames& names, LaterParams& params, const ImportContext& context,
              DirectiveText* text) {
  const ParsedParam* param = params.Take(names.from);
  if (param && param->type == "texture") {
    text->Copy(*param, names.to);
    return;
  }
  const Rgb color =
      param ? ReadRgb(*param, names.fallback, ColorUse::Material, context) : names.fallback;
  text->Numbers(std::string("color ") + names.to, NumbersOf(color));
}

}  // namespace exphoton::cli
