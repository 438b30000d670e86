// SPDX-License-Identifier: BSD-2-Clause
// ImportMaterial4 converts the materials of version 4. "diffuse" and "diffusetransmission" are
// exact. Smooth metals become "shinymetal", which has the same reflectance at normal incidence.
// Coats become "uber" with a darker base.
#include <algorithm>
#include <cmath>

#include "core/app/import/materials/material_parts.h"
#include "core/scattering/subsurface_reflectance.h"

namespace exphoton::cli {
namespace {

// Reflectance of diffuse light at a smooth boundary of this index, from inside and from outside.
// The outside follows by energy balance.
struct DiffuseFresnel {
  double inside, outside;
  explicit DiffuseFresnel(double eta)
      : inside(InternalReflectance(eta)), outside(1 - (1 - inside) * eta * eta) {}
};

// Returns the share of light that leaves a diffuse base under a coat, with all reflections between
// base and coat.
double CoatedReflectance(double base, double eta) {
  if (eta <= 1) return base;
  const DiffuseFresnel fresnel(eta);
  return std::clamp(
      (1 - fresnel.outside) * (1 - fresnel.inside) * base / (1 - fresnel.inside * base), 0., 1.);
}

double NormalReflectance(double eta, double k) {
  return ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
}

class Material4Importer : private MaterialImporter {
 public:
  Material4Importer(const MaterialHead& head, LaterParams& params, const ImportContext& context)
      : MaterialImporter(head, params, context) {}

  std::string Diffuse() {
    DirectiveText text = head_.Text("matte");
    AddColor({"reflectance", "Kd", kHalf}, params_, context_, &text);
    return End(&text);
  }

  std::string DiffuseTransmission() {
    DirectiveText text = head_.Text("translucent");
    const double scale = params_.TakeNumber("scale", 1);
    text.Numbers("color Kd", {scale, scale, scale}).Numbers("color Ks", {0, 0, 0});
    AddColor({"reflectance", "reflect", kQuarter}, params_, context_, &text);
    AddColor({"transmittance", "transmit", kQuarter}, params_, context_, &text);
    return End(&text);
  }

  std::string CoatedDiffuse() {
    DirectiveText text = head_.Text("uber");
    const double eta = Index("eta");
    const ParsedParam* base = params_.Take("reflectance");
    if (base && base->type == "texture") {
      text.Copy(*base, "Kd");
      params_.Replaced(*base, "is a texture: its light within the coat is not followed");
    } else {
      Rgb color = base ? ReadRgb(*base, kHalf, ColorUse::Material, context_) : kHalf;
      for (double& value : color) value = CoatedReflectance(value, eta);
      text.Numbers("color Kd", NumbersOf(color));
    }
    text.Number("float index", eta).String("string fresnel", "physical");
    const bool isSmooth = AddRoughness({"", 0}, params_, context_, &text);
    text.Numbers("color Ks", isSmooth ? std::vector<double>{0, 0, 0} : NumbersOf(kOne));
    text.Numbers("color Kr", isSmooth ? NumbersOf(kOne) : std::vector<double>{0, 0, 0});
    params_.Ignore({"maxdepth", "nsamples", "thickness"});
    params_.Replaced("is replaced by \"uber\": the coat reflects over a darker diffuse base");
    return End(&text);
  }

  std::string Conductor() {
    if (params_.Has("reflectance")) return Metal("", "reflectance", 0);
    return Metal("", "", 0);
  }

  std::string CoatedConductor() {
    params_.Ignore({"maxdepth", "nsamples", "thickness", "interface.eta", "interface.roughness",
                    "interface.uroughness", "interface.vroughness"});
    params_.Replaced("is replaced by its metal without the coat");
    return Metal("conductor.", params_.Has("reflectance") ? "reflectance" : "", 0);
  }

  std::string Dielectric() {
    DirectiveText text = head_.Text("glass");
    text.Numbers("color Kr", NumbersOf(kOne)).Numbers("color Kt", NumbersOf(kOne));
    text.Number("float index", Index("eta"));
    ReplaceRoughness({}, params_);
    return End(&text);
  }

  std::string ThinDielectric() {
    DirectiveText text = head_.Text("glass");
    text.Number("float index", 1);
    params_.Ignore({"eta"});
    params_.Replaced("is replaced by an invisible surface: thin panes do not reflect here");
    return End(&text);
  }

  std::string Mix() {
    DirectiveText text = head_.Text("mix");
    const ParsedParam* names = params_.Take("materials");
    if (!names || names->strings.size() != 2)
      throw Error(ExitStatus::Scene, params_.Subject() + " needs \"string materials\" of two names",
                  params_.Where());
    // Version 4 gives the share of the second material.
    text.String("string namedmaterial1", names->strings[1]);
    text.String("string namedmaterial2", names->strings[0]);
    const ParsedParam* amount = params_.Take("amount");
    if (amount && amount->type == "texture") {
      params_.Replaced(*amount, "is a texture: 0.5 takes its place");
      amount = nullptr;
    }
    const Rgb share = amount ? ReadRgb(*amount, kHalf, ColorUse::Material, context_) : kHalf;
    text.Numbers("color amount", NumbersOf(share));
    return End(&text);
  }

 private:
  double Index(const std::string& name) {
    const ParsedParam* param = params_.Take(name);
    return param ? ReadIndex(*param, 1.5, params_, context_) : 1.5;
  }
  Rgb Color(const std::string& name, const Rgb& fallback) {
    const ParsedParam* param = params_.Take(name);
    if (!param) return fallback;
    if (param->type != "texture") return ReadRgb(*param, fallback, ColorUse::Material, context_);
    params_.Replaced(*param, "is a texture: a constant takes its place");
    return fallback;
  }

  // Returns "metal", or "shinymetal" if it is smooth. `reflectance` names the parameter that gives
  // the colour at normal incidence, or is empty.
  std::string Metal(const std::string& prefix, const std::string& reflectance, double roughness) {
    Rgb eta = Color(prefix + "eta", kCopperEta), k = Color(prefix + "k", kCopperK);
    if (!reflectance.empty()) {
      const Rgb color = Color(reflectance, kHalf);
      for (std::size_t c = 0; c < 3; ++c) {
        const double r = std::clamp(color[c], 0., .9999);
        eta[c] = 1;
        k[c] = 2 * std::sqrt(r) / std::sqrt(std::max(1 - r, 0.));
      }
    }
    DirectiveText rough = head_.Text("metal");
    rough.Numbers("color eta", NumbersOf(eta)).Numbers("color k", NumbersOf(k));
    if (!AddRoughness({prefix, roughness}, params_, context_, &rough)) return End(&rough);
    DirectiveText smooth = head_.Text("shinymetal");
    Rgb normal;
    for (std::size_t c = 0; c < 3; ++c) normal[c] = NormalReflectance(eta[c], k[c]);
    smooth.Numbers("color Kr", NumbersOf(normal)).Numbers("color Ks", {0, 0, 0});
    params_.Replaced(
        "is smooth and becomes \"shinymetal\": its reflectance is the same only at normal "
        "incidence");
    return End(&smooth);
  }
};

}  // namespace

std::optional<std::string> ImportMaterial4(const std::string& type, const MaterialHead& head,
                                           LaterParams& params, const ImportContext& context) {
  Material4Importer importer(head, params, context);
  if (type.empty() || type == "none" || type == "interface") return {};
  if (type == "diffuse") return importer.Diffuse();
  if (type == "coateddiffuse") return importer.CoatedDiffuse();
  if (type == "conductor") return importer.Conductor();
  if (type == "coatedconductor") return importer.CoatedConductor();
  if (type == "dielectric") return importer.Dielectric();
  if (type == "thindielectric") return importer.ThinDielectric();
  if (type == "diffusetransmission") return importer.DiffuseTransmission();
  if (type == "mix") return importer.Mix();
  return ReplaceByMatte(type, head, params, context);
}

}  // namespace exphoton::cli
