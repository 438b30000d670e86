// SPDX-License-Identifier: BSD-2-Clause
// This file converts "name=value" from the command line to a ParsedParam, as if a scene file had
// given it.
#include "core/parser/overrides.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "core/base/log.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

constexpr std::array<std::string_view, 7> kSettableDirectives{
    "Accelerator",       "Camera",          "Film", "PixelFilter", "Sampler",
    "SurfaceIntegrator", "VolumeIntegrator"};

const ParamDecl* FindDeclaration(const std::vector<ParamDecl>& declared, std::string_view name) {
  const auto found = std::find_if(declared.begin(), declared.end(),
                                  [&](const ParamDecl& decl) { return decl.name == name; });
  return found == declared.end() ? nullptr : &*found;
}

std::string FileType(ParamType type, bool isNumeric) {
  switch (type) {
    case ParamType::Integer:
    case ParamType::IntegerList:
      return "integer";
    case ParamType::Float:
    case ParamType::FloatList:
    case ParamType::Point2List:
      return "float";
    case ParamType::Bool:
      return "bool";
    case ParamType::String:
    case ParamType::Choice:
    case ParamType::File:
      return "string";
    case ParamType::Color:
      return "color";
    case ParamType::Point:
    case ParamType::PointList:
      return "point";
    case ParamType::Vector:
    case ParamType::VectorList:
      return "vector";
    case ParamType::Normal:
    case ParamType::NormalList:
      return "normal";
    case ParamType::FloatTexture:
      return isNumeric ? "float" : "texture";
    case ParamType::ColorTexture:
      return isNumeric ? "color" : "texture";
  }
  return "string";
}

// Parses numbers separated by blanks or commas. Returns nullopt if any word is not a number.
std::optional<std::vector<double>> ParseNumbers(std::string_view text) {
  constexpr std::string_view kSeparators = " ,\t[]";
  std::vector<double> numbers;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(kSeparators), text.size()));
    if (text.empty()) break;
    std::string_view word = text.substr(0, text.find_first_of(kSeparators));
    text.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number))
      return std::nullopt;
    numbers.push_back(number);
  }
  if (numbers.empty()) return std::nullopt;
  return numbers;
}

SourceLocation LocationOf(const ParameterOverride& override) {
  SourceLocation where;
  where.file = kCommandLineLocation;
  where.line = 1;
  where.lineText = "--set " + override.directive + "." + override.parameter + "=" + override.value;
  where.column = int(where.lineText.size() - override.value.size()) + 1;
  return where;
}

ParsedParam ParamOf(const ParameterOverride& override, ParamType type) {
  const std::optional<std::vector<double>> numbers = ParseNumbers(override.value);
  ParsedParam param;
  param.name = override.parameter;
  param.type = FileType(type, numbers.has_value());
  param.where = LocationOf(override);
  const bool takesText = param.type == "string" || param.type == "bool" || param.type == "texture";
  if (takesText) {
    param.strings.push_back(override.value);
  } else if (numbers) {
    param.numbers = *numbers;
  } else {
    throw Error(ExitStatus::CommandLine,
                "parameter \"" + param.name + "\" takes numbers, not \"" + override.value + "\"",
                param.where);
  }
  return param;
}

}  // namespace

void CheckOverrides(const std::vector<ParameterOverride>& overrides) {
  for (const ParameterOverride& override : overrides) {
    if (std::find(kSettableDirectives.begin(), kSettableDirectives.end(), override.directive) !=
        kSettableDirectives.end())
      continue;
    const std::vector<std::string> known(kSettableDirectives.begin(), kSettableDirectives.end());
    std::string list;
    for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
    throw Error(ExitStatus::CommandLine,
                "--set: \"" + override.directive + "\" cannot be set; available: " + list,
                LocationOf(override), DidYouMean(override.directive, known));
  }
}

void ApplyOverrides(const std::vector<ParameterOverride>& overrides, const std::string& directive,
                    const std::string& what, const ParamTableBase& table, ParamSet* params) {
  for (const ParameterOverride& override : overrides) {
    if (override.directive != directive) continue;
    const ParamDecl* declaration = FindDeclaration(table.Declarations(), override.parameter);
    if (!declaration) {
      table.RefuseRemoved(override.parameter, what, LocationOf(override));
      std::vector<std::string> known;
      for (const ParamDecl& decl : table.Declarations()) known.push_back(decl.name);
      throw Error(ExitStatus::CommandLine,
                  "--set: unknown parameter \"" + override.parameter + "\" of " + what,
                  LocationOf(override), DidYouMean(override.parameter, known));
    }
    params->Add(ParamOf(override, declaration->type));
  }
}

bool Declares(const std::vector<ParamDecl>& declared, const std::string& parameter) {
  return FindDeclaration(declared, parameter) != nullptr;
}

bool MeansTheSame(const ParamDecl& a, const ParamDecl& b) {
  return a.name == b.name && a.type == b.type && a.unit == b.unit && a.doc == b.doc;
}

void KeepSharedParameters(const IntegratorChange& change, Log& log, ParamSet* params) {
  ParamSet kept;
  kept.where = params->where;
  for (const ParsedParam& param : params->All()) {
    const ParamDecl* to = FindDeclaration(change.to, param.name);
    const ParamDecl* from = change.from ? FindDeclaration(*change.from, param.name) : nullptr;
    if (!to || (from && MeansTheSame(*from, *to))) {
      kept.Add(param);
    } else {
      log.Notice("parameter \"" + param.name + "\" of integrator \"" + change.fromName +
                     "\" does not apply to integrator \"" + change.toName +
                     "\", where it has another meaning",
                 param.where, "--set SurfaceIntegrator." + param.name + "=VALUE sets it");
    }
  }
  *params = std::move(kept);
}

void AddNamedDefaults(const std::vector<ParamDecl>& declared, ParamSet* params) {
  for (const ParamDecl& declaration : declared) {
    if (!declaration.namedDefault || params->Find(declaration.name)) continue;
    ParsedParam param;
    param.name = declaration.name;
    param.type = FileType(declaration.type, true);
    param.where = params->where;
    param.numbers = {*declaration.namedDefault};
    params->Add(std::move(param));
  }
}

void ShiftExposure(const std::vector<ParamDecl>& declared, const std::string& what, Real offset,
                   ParamSet* params) {
  for (const char* name : {"shutteropen", "shutterclose"}) {
    const ParamDecl* const declaration = FindDeclaration(declared, name);
    const auto value = declaration ? ParseNumbers(declaration->defaultText) : std::nullopt;
    if (!value)
      throw Error(ExitStatus::CommandLine,
                  "--frames needs a camera that declares " + std::string(name) +
                      " with a default, but " + what + " does not",
                  {}, "--frame-time 0 leaves the exposure as it is");
    ParsedParam param;
    if (const ParsedParam* given = params->Find(name)) {
      if (given->numbers.size() != 1) continue;  // malformed: the binder reports the error
      param = *given;
    } else {
      param.name = name;
      param.type = "float";
      param.where = params->where;
      param.numbers = *value;
    }
    param.numbers[0] += double(offset);
    params->Add(std::move(param));
  }
}

void ScaleForQuick(const std::vector<ParamDecl>& declared, ParamSet* params) {
  for (const ParamDecl& declaration : declared) {
    if (declaration.quickDivisor == 1) continue;
    ParsedParam param;
    if (const ParsedParam* given = params->Find(declaration.name)) {
      if (given->numbers.size() != 1) continue;  // malformed: the binder reports the error
      param = *given;
    } else {
      const std::optional<std::vector<double>> value = ParseNumbers(declaration.defaultText);
      if (!value) continue;  // no numeric default: the plugin derives the value
      param.name = declaration.name;
      param.type = "integer";
      param.where = params->where;
      param.numbers = *value;
    }
    const double least = std::max(declaration.min.value_or(1), param.numbers[0] > 0 ? 1.0 : 0.0);
    const double scaled = std::floor(param.numbers[0] / declaration.quickDivisor);
    param.numbers[0] = std::min(param.numbers[0], std::max(scaled, least));
    params->Add(std::move(param));
  }
}

}  // namespace exphoton
