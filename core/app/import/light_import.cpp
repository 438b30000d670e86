// SPDX-License-Identifier: BSD-2-Clause
// ImportLight multiplies the colour, the scale and the film's factor. Version 4
// states the power or illuminance of a white light, and the colour multiplies it.
#include "core/app/import/light_import.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/app/import/directive_text.h"
#include "core/app/import/reading/later_color.h"
#include "core/app/import/reading/later_params.h"
#include "core/params/scene_path.h"

namespace exphoton::cli {
namespace {

constexpr double kLightPi = std::numbers::pi;

double CosDegrees(double degrees) { return std::cos(degrees * kLightPi / 180); }

class LightImporter {
 public:
  LightImporter(const Directive& directive, const std::string& name, const ImportContext& context)
      : context_(context),
        params_(directive.params, name + " " + QuotedText(directive.strings[0]), context.report) {}

  std::string Light(const std::string& type) {
    if (type == "point") return Point();
    if (type == "spot") return Spot();
    if (type == "distant") return Distant();
    if (type == "infinite" || type == "exinfinite") return Infinite();
    if (context_.version == 3 && (type == "goniometric" || type == "projection"))
      return WithMap(type);
    context_.report.LeftOut(params_.Subject() + " is left out", params_.Where());
    return "";
  }

  std::string Area() {
    DirectiveText text("AreaLightSource", {"area"});
    Color("L", 1, &text);
    if (params_.TakeBool("twosided", false))
      params_.LeftOut(*params_.Take("twosided"), "only the side of the normal shines");
    if (const ParsedParam* power = params_.Take("power"))
      params_.LeftOut(*power, "\"L\" alone decides the brightness");
    return End(&text);
  }

 private:
  // Writes the product of the parameter `name`, of "scale" and of `factor`.
  void Color(const char* name, double factor, DirectiveText* text) {
    constexpr Rgb kWhite{1, 1, 1};
    const ParsedParam* color = params_.Take(name);
    const ParsedParam* scale = params_.Take("scale");
    Rgb rgb = color ? ReadRgb(*color, kWhite, ColorUse::Light, context_) : kWhite;
    const Rgb scales = scale ? ReadRgb(*scale, kWhite, ColorUse::Material, context_) : kWhite;
    for (std::size_t c = 0; c < 3; ++c) rgb[c] *= scales[c] * factor * context_.lightFactor;
    text->Numbers(std::string("color ") + name, NumbersOf(rgb));
  }

  // Returns the factor that gives a light of intensity 1 the power that the scene states: `unit` is
  // its power or illuminance.
  double FactorFor(const char* name, double unit) {
    const double wanted = params_.TakeNumber(name, -1);
    return wanted > 0 ? wanted / unit : 1;
  }

  void Copy(const char* name, DirectiveText* text) {
    if (const ParsedParam* param = params_.Take(name)) text->Copy(*param, name);
  }

  std::string End(DirectiveText* text) {
    params_.Ignore({"samples", "nsamples"});
    params_.ReportRest();
    return text->Text();
  }

  std::string Point() {
    DirectiveText text("LightSource", {"point"});
    Color("I", FactorFor("power", 4 * kLightPi), &text);
    Copy("from", &text);
    return End(&text);
  }

  std::string Spot() {
    DirectiveText text("LightSource", {"spot"});
    const double cone = params_.TakeNumber("coneangle", 30);
    // A rim wider than the cone goes beyond its axis in versions 3 and 4.
    const double rim = params_.TakeNumber("conedeltaangle", 5);
    const double delta = std::max(cone - std::abs(cone - rim), 0.);
    const double outer = CosDegrees(cone), inner = CosDegrees(cone - delta);
    Color("I", FactorFor("power", 2 * kLightPi * ((1 - inner) + (inner - outer) / 5)), &text);
    // The rim of version 3 is the quartic of version 1, whose mean is 1/5.
    if (context_.version == 4 && delta > 0)
      params_.Replaced("falls off by a quartic in the rim of its cone, and not by a smooth step");
    Copy("from", &text);
    Copy("to", &text);
    text.Number("float coneangle", cone).Number("float conedeltaangle", delta);
    return End(&text);
  }

  std::string Distant() {
    DirectiveText text("LightSource", {"distant"});
    Color("L", FactorFor("illuminance", 1), &text);
    Copy("from", &text);
    Copy("to", &text);
    return End(&text);
  }

  std::string Infinite() {
    DirectiveText text("LightSource", {"infinite"});
    const ParsedParam* map = params_.Take(context_.version == 4 ? "filename" : "mapname");
    const bool hasMap = map && map->strings.size() == 1;
    Color("L", hasMap ? 1 : FactorFor("illuminance", kLightPi), &text);
    if (hasMap && context_.version == 4) {
      text.String("string mapname", SkyMapName(*map));
    } else if (hasMap) {
      text.String("string mapname", FileNameFor(map->strings[0], map->where, context_));
    }
    return End(&text);
  }

  std::string WithMap(const std::string& type) {
    DirectiveText text("LightSource", {type});
    Color("I", 1, &text);
    Copy("fov", &text);
    if (const ParsedParam* map = params_.Take("mapname"); map && map->strings.size() == 1)
      text.String("string mapname", FileNameFor(map->strings[0], map->where, context_));
    return End(&text);
  }

  // Returns the name of the map of latitude and longitude that is made from a map of version 4.
  std::string SkyMapName(const ParsedParam& map) {
    namespace fs = std::filesystem;
    const std::string source = ResolveScenePath(map.strings[0], map.where);
    if (!fs::exists(source)) return FileNameFor(map.strings[0], map.where, context_);
    const auto known = context_.skyMaps.find(source);
    if (known != context_.skyMaps.end()) return known->second;
    const std::string name = fs::path(context_.outputFile).stem().string() + "-sky" +
                             std::to_string(context_.skyMaps.size() + 1) + ".exr";
    params_.Note("has its map converted to latitude and longitude: \"" + name + "\"");
    return context_.skyMaps[source] = name;
  }

  const ImportContext& context_;
  LaterParams params_;
};

}  // namespace

std::string ImportLight(const Directive& directive, const ImportContext& context) {
  return LightImporter(directive, "LightSource", context).Light(directive.strings[0]);
}

std::string ImportAreaLight(const Directive& directive, const ImportContext& context) {
  if (directive.strings[0] == "diffuse" || directive.strings[0] == "area")
    return LightImporter(directive, "AreaLightSource", context).Area();
  context.report.LeftOut("AreaLightSource " + QuotedText(directive.strings[0]) + " is left out",
                         directive.Where());
  return "";
}

}  // namespace exphoton::cli
