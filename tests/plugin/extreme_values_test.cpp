// SPDX-License-Identifier: BSD-2-Clause
// These tests give every parameter of every plugin extreme values. A value within the declared
// range must be accepted or refused by a rule of the plugin. A value outside the range must cause
// an error that names the parameter. No other outcome is allowed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/params/param_reader.h"
#include "core/scene/primitive.h"
#include "tests/support/test_plugin.h"

namespace exphoton {
namespace {

const std::vector<double>& SpecialNumbers() {
  static const std::vector<double> numbers{
      0.,    -0.,   1.,          -1.,          .5,          1e-45, -1e-45,   1e-30,    1e38,
      -1e38, 1e300, 2147483647., -2147483648., 4294967296., NAN,   INFINITY, -INFINITY};
  return numbers;
}

// Returns how many numbers one value of the type has, or 0 for a type without numbers.
int NumbersOf(ParamType type) {
  switch (type) {
    case ParamType::Bool:
    case ParamType::String:
    case ParamType::Choice:
    case ParamType::File:
      return 0;
    case ParamType::Color:
    case ParamType::ColorTexture:
    case ParamType::Point:
    case ParamType::Vector:
    case ParamType::Normal:
    case ParamType::PointList:
    case ParamType::VectorList:
    case ParamType::NormalList:
      return 3;
    case ParamType::Point2List:
      return 2;
    default:
      return 1;
  }
}

bool IsInteger(ParamType type) {
  return type == ParamType::Integer || type == ParamType::IntegerList;
}

// Returns whether the number is a valid value by the parameter's declaration.
bool IsInRange(const ParamDecl& decl, double number) {
  const double rounded = double(Real(number));
  if (!std::isfinite(number) || !std::isfinite(rounded)) return false;
  if (IsInteger(decl.type) &&
      (number != std::trunc(number) || number < decl.lowest || number > decl.highest)) {
    return false;
  }
  if (decl.min && (decl.minExcluded ? rounded <= double(Real(*decl.min)) : number < *decl.min)) {
    return false;
  }
  return !decl.max || (decl.maxExcluded ? rounded < double(Real(*decl.max)) : number <= *decl.max);
}

// Returns whether the value is allowed but slow: each subdivision level quadruples the triangles.
bool TakesLong(const ParamDecl& decl, double number) {
  return decl.name == "nlevels" && number > 6 && IsInRange(decl, number);
}

ParsedParam Declared(const ParamDecl& decl) {
  ParsedParam param;
  param.type = std::string(AcceptedTypes(decl.type)[0]);
  param.name = decl.name;
  return param;
}

// Returns valid values for all required parameters except the parameter under test.
ParamSet Required(const ParamTableBase& table, const std::string& except) {
  ParamSet params;
  for (const ParamDecl& decl : table.Declarations()) {
    if (!decl.isRequired || decl.name == except) continue;
    ParsedParam param = Declared(decl);
    if (decl.type == ParamType::IntegerList) param.numbers = {0, 1, 2};
    if (decl.type == ParamType::PointList) param.numbers = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    if (decl.type == ParamType::Integer || decl.type == ParamType::Float) param.numbers = {2};
    if (decl.type == ParamType::FloatList) param.numbers = {0, 0, 1, 1};
    if (decl.type == ParamType::File || decl.type == ParamType::String)
      param.strings = {"/nowhere.exr"};
    params.Add(param);
  }
  return params;
}

class ExtremeValues : public ::testing::TestWithParam<int> {
 protected:
  ExtremeValues() : surface_(plugins_.MakeEmitter("\"disk\"")) { primitives_.Finish(); }

  void Make(PluginKind kind, const std::string& name, const ParamSet& params) {
    switch (kind) {
      case PluginKind::Integrator:
        return MakeOne<PluginKind::Integrator>(name, params, {plugins_.GetLog()});
      case PluginKind::Accelerator:
        return MakeOne<PluginKind::Accelerator>(name, params, {primitives_, plugins_.GetLog()});
      case PluginKind::Shape:
        return MakeOne<PluginKind::Shape>(name, params, {{}, false, plugins_.GetLog(), {}});
      case PluginKind::Light:
        return MakeOne<PluginKind::Light>(name, params, {{}, plugins_.GetLog(), {}});
      case PluginKind::AreaLight:
        return MakeOne<PluginKind::AreaLight>(name, params, {surface_, plugins_.GetLog(), {}});
      case PluginKind::Material:
        return MakeOne<PluginKind::Material>(name, params, {plugins_.GetLog(), {}});
      case PluginKind::FloatTexture:
        return MakeOne<PluginKind::FloatTexture>(name, params,
                                                 {{}, plugins_.GetLog(), {}, shared_});
      case PluginKind::ColorTexture:
        return MakeOne<PluginKind::ColorTexture>(name, params,
                                                 {{}, plugins_.GetLog(), {}, shared_});
      case PluginKind::Sampler:
        return MakeOne<PluginKind::Sampler>(name, params, {plugins_.GetLog(), {}});
      case PluginKind::Filter:
        return MakeOne<PluginKind::Filter>(name, params, {});
      case PluginKind::Camera:
        return MakeOne<PluginKind::Camera>(name, params, {{}, 4, 3});
      case PluginKind::Volume:
        return MakeOne<PluginKind::Volume>(name, params, {{}, plugins_.GetLog(), {}});
      case PluginKind::VolumeIntegrator:
        return MakeOne<PluginKind::VolumeIntegrator>(name, params, {});
    }
  }
  template <PluginKind kind>
  void MakeOne(const std::string& name, const ParamSet& params,
               const typename PluginTraits<kind>::Context& context) {
    BindContext bind;
    bind.log = &plugins_.GetLog();
    plugins_.Registry().Create<kind>(name, params, bind, context);
  }

  void Try(PluginKind kind, const std::string& name, const ParamDecl& decl, double number) {
    SCOPED_TRACE(name + "." + decl.name + " = " + std::to_string(number));
    ParamSet params = Required(*plugins_.Registry().Find(kind, name, {}).parameters, decl.name);
    ParsedParam param = Declared(decl);
    param.numbers.assign(std::size_t(NumbersOf(decl.type)), number);
    params.Add(param);
    const bool isInRange = IsInRange(decl, number);
    try {
      Make(kind, name, params);
      EXPECT_TRUE(isInRange) << "was accepted";
    } catch (const Error& error) {
      EXPECT_TRUE(error.Status() == ExitStatus::Scene || error.Status() == ExitStatus::Resource);
      if (!isInRange) {
        EXPECT_EQ(std::string(error.what()).rfind("parameter \"" + decl.name + "\" of ", 0), 0u)
            << error.what();
      }
    }
  }

  TestPlugins plugins_;
  SharedCache shared_;
  std::shared_ptr<const EmitterSurface> surface_;
  PrimitiveSet primitives_;
};

TEST_P(ExtremeValues, AreAcceptedInRangeAndRefusedOutsideOfIt) {
  const auto kind = static_cast<PluginKind>(GetParam());
  for (const std::string& name : plugins_.Registry().Available(kind)) {
    const ParamTableBase& table = *plugins_.Registry().Find(kind, name, {}).parameters;
    for (const ParamDecl& decl : table.Declarations()) {
      if (NumbersOf(decl.type) == 0) continue;
      std::vector<double> numbers = SpecialNumbers();
      for (const std::optional<double>& bound : {decl.min, decl.max}) {
        if (!bound) continue;
        numbers.push_back(*bound);
        numbers.push_back(std::nextafter(*bound, -INFINITY));
        numbers.push_back(std::nextafter(*bound, INFINITY));
      }
      for (const double number : numbers) {
        if (!TakesLong(decl, number)) Try(kind, name, decl, number);
      }
    }
  }
}

TEST_P(ExtremeValues, OfTextAreErrorsOrAccepted) {
  const auto kind = static_cast<PluginKind>(GetParam());
  for (const std::string& name : plugins_.Registry().Available(kind)) {
    const ParamTableBase& table = *plugins_.Registry().Find(kind, name, {}).parameters;
    for (const ParamDecl& decl : table.Declarations()) {
      if (NumbersOf(decl.type) > 0) continue;
      for (const std::string& text : {std::string(), std::string("no such thing"),
                                      std::string(100000, 'x'), std::string("\0a", 2)}) {
        ParamSet params = Required(table, decl.name);
        ParsedParam param = Declared(decl);
        param.strings = {text};
        params.Add(param);
        try {
          Make(kind, name, params);
        } catch (const Error& error) {
          EXPECT_EQ(error.Status(), ExitStatus::Scene) << error.what();
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExtremeValues, ::testing::Range(0, kPluginKindCount),
                         [](const ::testing::TestParamInfo<int>& info) {
                           std::string name = PluginKindName(static_cast<PluginKind>(info.param));
                           std::erase(name, ' ');
                           return name;
                         });

}  // namespace
}  // namespace exphoton
