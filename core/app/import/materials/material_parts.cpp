// SPDX-License-Identifier: BSD-2-Clause
// GlossOf matches lobes near their peak. Versions 3 and 4 give the width of a Trowbridge-Reitz
// distribution, and the materials here have a Blinn exponent: e = 2 / alpha^2 - 2 (Walter et al.
// 2007, Microfacet Models for Refraction through Rough Surfaces, section 5.2).
#include "core/app/import/materials/material_parts.h"

#include <algorithm>
#include <cmath>

#include "core/scattering/subsurface_reflectance.h"

namespace exphoton::cli {
namespace {

// Returns the parameter that gives the roughness along u ('u') or v ('v'); null: the default.
const ParsedParam* TakeRoughness(const std::string& prefix, char axis, LaterParams& params) {
  const ParsedParam* own = params.Take(prefix + axis + "roughness");
  const ParsedParam* both = params.Take(prefix + "roughness");
  return own ? own : both;
}

// Replaces the coefficient by the parameter, if it is given.
void ReadCoefficient(const char* name, LaterParams& params, const ImportContext& context,
                     Rgb* coefficient) {
  const ParsedParam* param = params.Take(name);
  if (param && param->type == "texture")
    params.Replaced(*param, "is a texture: a constant takes its place");
  else if (param)
    *coefficient = ReadRgb(*param, *coefficient, ColorUse::Material, context);
}

// Returns the color that the medium of a "subsurface" reflects. The scale has no influence.
Rgb ReadMedium(LaterParams& params, const ImportContext& context) {
  params.Ignore({"scale"});
  const std::string name = params.TakeString("name", "");
  const auto measured = MeasuredCoefficients(name);
  const bool isComplete = params.Has("sigma_a") && params.Has("sigma_s");
  if (!name.empty() && !measured && !isComplete)
    params.Replaced(*params.Take("name"),
                    "is no known medium: \"" + std::string(kDefaultMedium) + "\" takes its place");
  SubsurfaceCoefficients medium = measured ? *measured : *MeasuredCoefficients(kDefaultMedium);
  ReadCoefficient("sigma_a", params, context, &medium.absorption);
  ReadCoefficient("sigma_s", params, context, &medium.reducedScattering);
  // The table has reduced coefficients. Others are reduced by the mean cosine.
  const double g = params.TakeNumber("g", 0);
  for (double& value : medium.reducedScattering) value *= measured ? 1 : 1 - g;
  const ParsedParam* eta = params.Take("eta");
  return DipoleReflectance(medium, eta ? ReadIndex(*eta, 1.33, params, context) : 1.33);
}

}  // namespace

double GlossOf(double roughness, bool isRemapped, int version) {
  double alpha = roughness;
  if (isRemapped && version == 4) alpha = std::sqrt(std::max(roughness, 0.));
  if (isRemapped && version == 3) {
    // The polynomial that version 3 documents for its scale of roughness.
    const double x = std::log(std::max(roughness, 1e-3));
    alpha = 1.62142 + x * (.819955 + x * (.1734 + x * (.0171201 + x * .000640711)));
  }
  alpha = std::clamp(alpha, 1e-3, .99);
  return alpha * alpha / (2 - 2 * alpha * alpha);
}

bool AddRoughness(const RoughnessNames& names, LaterParams& params, const ImportContext& context,
                  DirectiveText* text) {
  const bool isRemapped = params.TakeBool("remaproughness", true);
  const ParsedParam* u = TakeRoughness(names.prefix, 'u', params);
  const ParsedParam* v = TakeRoughness(names.prefix, 'v', params);
  const auto number = [&](const ParsedParam* param) {
    return param && param->numbers.size() == 1 ? param->numbers[0] : names.fallback;
  };
  for (const ParsedParam* param : {u, v})
    if (param && param->type == "texture")
      params.Replaced(
          *param, "is a texture: the constant " + ExactText(names.fallback) + " takes its place");
  if (number(u) == 0 && number(v) == 0) return true;
  const double along = GlossOf(number(u), isRemapped, context.version);
  const double across = GlossOf(number(v), isRemapped, context.version);
  if (names.isSeparate) {
    text->Number("float uroughness", along).Number("float vroughness", across);
    return false;
  }
  if (along != across)
    params.Replaced("is as rough in all directions: the mean of its two roughnesses");
  text->Number("float roughness", std::sqrt(along * across));
  return false;
}

void ReplaceRoughness(const RoughnessNames& names, LaterParams& params) {
  params.Ignore({"remaproughness"});
  for (const char axis : {'u', 'v'}) {
    const ParsedParam* param = TakeRoughness(names.prefix, axis, params);
    if (param && (param->type == "texture" || param->numbers != std::vector<double>{0}))
      params.Replaced(*param, "is left out: the surface is smooth");
  }
}

void AddBump(LaterParams& params, DirectiveText* text) {
  for (const char* name : {"bumpmap", "displacement"})
    if (const ParsedParam* bump = params.Take(name)) {
      if (bump->type == "texture") text->Copy(*bump, "bumpmap");
    }
}

std::string ReplaceByMatte(const std::string& type, const MaterialHead& head, LaterParams& params,
                           const ImportContext& context) {
  DirectiveText text = head.Text("matte");
  const char* color = "Kd";
  for (const char* name : {"color", "reflectance"})
    if (params.Has(name)) color = name;
  const bool isMedium = type == "subsurface" && !params.Has(color);
  AddColor({color, "Kd", isMedium ? ReadMedium(params, context) : kHalf}, params, context, &text);
  AddBump(params, &text);
  params.Replaced("is replaced by \"matte\": there is no material \"" + type + "\" here");
  return text.Text();
}

DirectiveText MaterialHead::Text(const std::string& material) const {
  if (!name) return {"Material", {material}};
  DirectiveText text("MakeNamedMaterial", {*name});
  text.String("string type", material);
  return text;
}

std::optional<std::string> ImportMaterial(const std::string& type, const MaterialHead& head,
                                          LaterParams& params, const ImportContext& context) {
  params.Ignore({"type"});
  auto text = context.version == 3 ? ImportMaterial3(type, head, params, context)
                                   : ImportMaterial4(type, head, params, context);
  params.ReportRest();
  return text;
}

}  // namespace exphoton::cli
