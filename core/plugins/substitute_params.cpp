// SPDX-License-Identifier: BSD-2-Clause
// The conversion of the material "subsurface" of versions 2 to 4 to "matte".
#include "core/plugins/substitute_params.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/base/log.h"
#include "core/params/suggestions.h"
#include "core/scattering/subsurface_reflectance.h"

namespace exphoton {
namespace {

struct SubsurfaceParameters {
  std::string medium;
  // Version 2 gives the reduced scattering. Later versions give the scattering and g.
  std::optional<Spectrum> absorption, reducedScattering, scattering;
  Real g = 0, index = Real(1.3), scale = 1;
};

const ParamTable<SubsurfaceParameters>& SubsurfaceTable() {
  using S = SubsurfaceParameters;
  static const ParamTable<S> table{
      Param("name", &S::medium, "a measured medium"),
      Param("sigma_a", &S::absorption, "absorption coefficient").AtLeast(0),
      Param("sigma_prime_s", &S::reducedScattering, "reduced scattering coefficient").AtLeast(0),
      Param("sigma_s", &S::scattering, "scattering coefficient").AtLeast(0),
      Param("g", &S::g, "mean cosine of scattering").Range(-1, 1),
      Param("index", &S::index, "index of refraction").Above(0),
      Param("eta", &S::index, "version 3's name of index").Above(0),
      Param("scale", &S::scale, "the diffuse reflectance does not depend on it").Ignored()};
  return table;
}

std::array<double, 3> ComponentsOf(const Spectrum& color) {
  return {double(color.r), double(color.g), double(color.b)};
}

// Coefficients that the parameters do not give are the medium's.
SubsurfaceCoefficients CoefficientsOf(const SubsurfaceParameters& given, const ParamSet& params,
                                      const BindContext& bind) {
  const std::optional<SubsurfaceCoefficients> named = MeasuredCoefficients(given.medium);
  const bool isComplete = given.absorption && (given.reducedScattering || given.scattering);
  if (!named && !given.medium.empty() && !isComplete && bind.log)
    bind.log->Warning("the medium \"" + given.medium + "\" of " + bind.what + " is not known: \"" +
                          kDefaultMedium + "\" is used instead",
                      params.Find("name")->where, DidYouMean(given.medium, MeasuredMedia()));
  SubsurfaceCoefficients medium = named ? *named : *MeasuredCoefficients(kDefaultMedium);
  if (given.absorption) medium.absorption = ComponentsOf(*given.absorption);
  if (given.reducedScattering) {
    medium.reducedScattering = ComponentsOf(*given.reducedScattering);
  } else {
    // The table has reduced coefficients. Others are reduced by the mean cosine.
    if (given.scattering) medium.reducedScattering = ComponentsOf(*given.scattering);
    for (double& value : medium.reducedScattering) value *= named ? 1 : 1 - double(given.g);
  }
  return medium;
}

// Returns the Kd of a medium that the parameters describe.
ParsedParam ReflectanceOf(const ParamSet& medium, const BindContext& bind) {
  BindContext own = bind;
  own.overrides = nullptr;
  const SubsurfaceParameters given = SubsurfaceTable().Bind(medium, own);
  ParsedParam kd;
  kd.type = "color";
  kd.where = medium.where;
  for (const double share :
       DipoleReflectance(CoefficientsOf(given, medium, bind), double(given.index)))
    kd.numbers.push_back(share);
  return kd;
}

// The file may give the color itself, as Kd or as version 4's reflectance. The latter is bound, and
// named in messages, as Kd. The medium then has no effect.
ParamSet MatteOfSubsurface(const ParamSet& params, const BindContext& bind) {
  ParamSet medium, matte;
  medium.where = matte.where = params.where;
  const ParsedParam* const reflectance = params.Find("reflectance");
  const auto& declared = SubsurfaceTable().Declarations();
  for (const ParsedParam& param : params.All()) {
    if (&param == reflectance) continue;
    const bool isOfMedium =
        std::any_of(declared.begin(), declared.end(),
                    [&](const ParamDecl& decl) { return decl.name == param.name; });
    (isOfMedium ? medium : matte).Add(param);
  }
  const ParsedParam* const given = matte.Find("Kd") ? matte.Find("Kd") : reflectance;
  const auto report = [&](const ParsedParam& param) {
    if (bind.log)
      bind.log->Notice("parameter \"" + param.name + "\" of " + bind.what + " has no effect: \"" +
                           given->name + "\" is given",
                       param.where);
  };
  if (given)
    for (const ParsedParam& param : medium.All()) report(param);
  if (given && given != reflectance) {
    if (reflectance) report(*reflectance);
    return matte;
  }
  ParsedParam kd = reflectance ? *reflectance : ReflectanceOf(medium, bind);
  kd.name = "Kd";
  matte.Add(std::move(kd));
  return matte;
}

bool IsSubsurface(PluginKind kind, const std::string& name) {
  return kind == PluginKind::Material && name == "subsurface";
}

}  // namespace

ParamSet ParamsOfSubstitute(PluginKind kind, const std::string& name, const ParamSet& params,
                            const BindContext& bind) {
  return IsSubsurface(kind, name) ? MatteOfSubsurface(params, bind) : params;
}

const std::vector<ParamDecl>* ConvertedParameters(PluginKind kind, const std::string& name) {
  return IsSubsurface(kind, name) ? &SubsurfaceTable().Declarations() : nullptr;
}

}  // namespace exphoton
