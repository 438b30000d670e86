// SPDX-License-Identifier: BSD-2-Clause
// ImportMaterial3 converts the materials of version 3. Most have the same name and parameters here;
// defaults are written out, because those of version 1 differ. "plastic" keeps the
// Fresnel term of version 1, but the terms of "uber" and "translucent" go from outside to inside.
#include "core/app/import/materials/material_parts.h"

namespace exphoton::cli {
namespace {

void AddFloat(const char* name, double fallback, LaterParams& params, DirectiveText* text) {
  const ParsedParam* param = params.Take(name);
  if (param) {
    text->Copy(*param, name);
  } else {
    text->Number(std::string("float ") + name, fallback);
  }
}

void AddIndex(LaterParams& params, const ImportContext& context, DirectiveText* text) {
  const ParsedParam* index = params.Take("index");
  const ParsedParam* eta = params.Take("eta");
  const ParsedParam* given = eta ? eta : index;
  if (given && given->type == "texture") {
    text->Copy(*given, "index");
  } else {
    text->Number("float index", given ? ReadIndex(*given, 1.5, params, context) : 1.5);
  }
}

class Material3Importer : private MaterialImporter {
 public:
  Material3Importer(const MaterialHead& head, LaterParams& params, const ImportContext& context)
      : MaterialImporter(head, params, context) {}

  std::string Matte() {
    DirectiveText text = head_.Text("matte");
    Color("Kd", kHalf, &text);
    AddFloat("sigma", 0, params_, &text);
    return End(&text);
  }
  std::string Plastic() {
    DirectiveText text = head_.Text("plastic");
    Color("Kd", kQuarter, &text);
    Color("Ks", kQuarter, &text);
    return Glossy(.1, &text);
  }
  std::string Metal() {
    DirectiveText text = head_.Text("metal");
    Color("eta", kCopperEta, &text);
    Color("k", kCopperK, &text);
    return Glossy(.01, &text);
  }
  std::string Glass() {
    DirectiveText text = head_.Text("glass");
    Color("Kr", kOne, &text);
    Color("Kt", kOne, &text);
    AddIndex(params_, context_, &text);
    ReplaceRoughness({}, params_);
    return End(&text);
  }
  std::string Mirror() {
    DirectiveText text = head_.Text("mirror");
    Color("Kr", {.9, .9, .9}, &text);
    return End(&text);
  }
  std::string Uber() {
    DirectiveText text = head_.Text("uber");
    Color("Kd", kQuarter, &text);
    Color("Ks", kQuarter, &text);
    Color("Kr", kZero, &text);
    Color("Kt", kZero, &text);
    Color("opacity", kOne, &text);
    AddIndex(params_, context_, &text);
    text.String("string fresnel", "physical");
    return Glossy(.1, &text);
  }
  std::string Substrate() {
    DirectiveText text = head_.Text("substrate");
    Color("Kd", kHalf, &text);
    Color("Ks", kHalf, &text);
    if (AddRoughness({"", .1, true}, params_, context_, &text))
      text.Number("float uroughness", .001).Number("float vroughness", .001);
    return End(&text);
  }
  std::string Translucent() {
    DirectiveText text = head_.Text("translucent");
    Color("Kd", kQuarter, &text);
    Color("Ks", kQuarter, &text);
    Color("reflect", kHalf, &text);
    Color("transmit", kHalf, &text);
    text.String("string fresnel", "physical");
    return Glossy(.1, &text);
  }
  std::string Mix() {
    DirectiveText text = head_.Text("mix");
    Color("amount", kHalf, &text);
    for (const char* name : {"namedmaterial1", "namedmaterial2"})
      text.String(std::string("string ") + name, params_.TakeString(name, ""));
    return End(&text);
  }

 private:
  void Color(const char* name, const Rgb& fallback, DirectiveText* text) {
    AddColor({name, name, fallback}, params_, context_, text);
  }
  std::string Glossy(double roughness, DirectiveText* text) {
    // The smallest roughness here has the Blinn exponent 1000.
    if (AddRoughness({"", roughness}, params_, context_, text))
      text->Number("float roughness", .001);
    return End(text);
  }
};

}  // namespace

std::optional<std::string> ImportMaterial3(const std::string& type, const MaterialHead& head,
                                           LaterParams& params, const ImportContext& context) {
  Material3Importer importer(head, params, context);
  if (type.empty() || type == "none") return {};
  if (type == "matte") return importer.Matte();
  if (type == "plastic") return importer.Plastic();
  if (type == "metal") return importer.Metal();
  if (type == "glass") return importer.Glass();
  if (type == "mirror") return importer.Mirror();
  if (type == "uber") return importer.Uber();
  if (type == "substrate") return importer.Substrate();
  if (type == "translucent") return importer.Translucent();
  if (type == "mix") return importer.Mix();
  return ReplaceByMatte(type, head, params, context);
}

}  // namespace exphoton::cli
