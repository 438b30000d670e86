// SPDX-License-Identifier: BSD-2-Clause
// This file parses settings and varied parameters, and expands their combinations.
#include "core/app/analysis/plan.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "core/params/suggestions.h"

namespace exphoton::study {
namespace {

std::string Trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Parses "name=value". Returns false for any other text.
bool ParseParameter(const std::string& text, Parameter* parameter) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == text.size()) return false;
  *parameter = {text.substr(0, equals), text.substr(equals + 1)};
  return true;
}

bool AppliesToAny(const std::string& parameter) {
  return parameter == "spp" || parameter.find('.') != std::string::npos;
}

std::string BudgetText(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", seconds);
  return text;
}

// Returns the varied parameters that apply to a base. One for its integrator or label overrides a
// general one.
std::vector<const VariedParameter*> VariedParametersOf(const Setting& base, const StudyPlan& plan,
                                                       const ParameterLookup& oracle) {
  std::vector<const VariedParameter*> chosen;
  for (const VariedParameter& varied : plan.varied) {
    const bool isSpecial = !varied.integrator.empty();
    if (isSpecial && varied.integrator != base.integrator && varied.integrator != base.label)
      continue;
    if (base.Find(varied.parameter)) continue;
    if (!isSpecial && !AppliesToAny(varied.parameter) &&
        !oracle.Has(base.integrator, varied.parameter))
      continue;
    const auto same = std::find_if(chosen.begin(), chosen.end(), [&](const VariedParameter* other) {
      return other->parameter == varied.parameter;
    });
    if (same == chosen.end())
      chosen.push_back(&varied);
    else if (isSpecial)
      *same = &varied;
  }
  return chosen;
}

void Multiply(const std::string& parameter, const std::vector<std::string>& values,
              std::vector<Setting>* settings) {
  std::vector<Setting> product;
  for (const Setting& setting : *settings) {
    for (const std::string& value : values) {
      product.push_back(setting);
      product.back().parameters.emplace_back(parameter, value);
    }
  }
  *settings = std::move(product);
}

[[noreturn]] void FailUnused(const VariedParameter& varied, const StudyPlan& plan,
                             const ParameterLookup& oracle) {
  std::vector<std::string> integrators, parameters{"spp"};
  bool isKnown = varied.integrator.empty();
  for (const Setting& base : plan.bases) {
    integrators.insert(integrators.end(), {base.integrator, base.label});
    const bool isMeant = varied.integrator == base.integrator || varied.integrator == base.label;
    isKnown = isKnown || isMeant;
    if (!isMeant && !varied.integrator.empty()) continue;
    const std::vector<std::string> names = oracle.Names(base.integrator);
    parameters.insert(parameters.end(), names.begin(), names.end());
  }
  const std::string hint = isKnown ? DidYouMean(varied.parameter, parameters)
                                   : DidYouMean(varied.integrator, integrators);
  throw std::invalid_argument("no setting has the varied parameter \"" + varied.parameter + "\"" +
                              (varied.integrator.empty() ? "" : " for " + varied.integrator) +
                              (hint.empty() ? "" : "; " + hint));
}

// Returns whether no name or value contains the separators of RunName.
bool HasPlainParts(const Setting& setting) {
  if (setting.integrator.find_first_of("_=") != std::string::npos) return false;
  return std::all_of(setting.parameters.begin(), setting.parameters.end(), [](const Parameter& p) {
    return (p.first + p.second).find_first_of("_=") == std::string::npos;
  });
}

// Parses a time. Throws std::invalid_argument.
double ParseSeconds(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  const std::string unit(next, end);
  const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" ? 60 : unit == "h" ? 3600 : 0;
  if (error != std::errc{} || !(value > 0) || factor == 0 || !(value * factor < 1e9))
    throw std::invalid_argument(
        "--budgets takes times above 0 in seconds or with a unit, such as 90s, 30m or 2h, not \"" +
        text + "\"");
  return value * factor;
}

// Returns eight digits that differ for different texts (FNV-1a).
std::string Digest(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  char digits[20];
  std::snprintf(digits, sizeof digits, "%08x", unsigned(hash ^ hash >> 32));
  return digits;
}

}  // namespace

std::string Setting::Text() const {
  std::string text;
  for (const auto& [name, value] : parameters)
    text += (text.empty() ? "" : " ") + name + "=" + value;
  return text.empty() ? "as the scene says" : text;
}

const std::string* Setting::Find(const std::string& parameter) const {
  for (const auto& [name, value] : parameters)
    if (name == parameter) return &value;
  return nullptr;
}

std::vector<std::string> SplitList(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
    if (!Trim(part).empty()) parts.push_back(Trim(part));
  return parts;
}

Setting ParseSetting(const std::string& text) {
  Setting setting;
  const std::size_t colon = text.find(": ");
  std::istringstream words(colon == std::string::npos ? text : text.substr(colon + 1));
  words >> setting.integrator;
  if (setting.integrator.empty() || setting.integrator.find('=') != std::string::npos)
    throw std::invalid_argument(
        "a setting must have the form \"[LABEL: ]INTEGRATOR [name=value ...]\", not \"" + text +
        "\"");
  setting.label = colon == std::string::npos ? setting.integrator : Trim(text.substr(0, colon));
  for (std::string word; words >> word;) {
    Parameter parameter;
    if (!ParseParameter(word, &parameter))
      throw std::invalid_argument("\"" + word + "\" of the setting \"" + text +
                                  "\" is not name=value");
    setting.parameters.push_back(parameter);
  }
  return setting;
}

VariedParameter ParseVariedParameter(const std::string& text) {
  VariedParameter varied;
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.substr(0, equals).rfind(':');
  if (colon != std::string::npos) varied.integrator = Trim(text.substr(0, colon));
  Parameter parameter;
  const std::string rest = colon == std::string::npos ? text : text.substr(colon + 1);
  if (ParseParameter(Trim(rest), &parameter)) {
    varied.parameter = parameter.first;
    varied.values = SplitList(parameter.second);
  }
  if (varied.values.empty())
    throw std::invalid_argument(
        "a parameter to vary must have the form \"[INTEGRATOR:]name=value,value,...\", not \"" +
        text + "\"");
  return varied;
}

std::vector<double> ParseBudgets(const std::string& text) {
  std::vector<std::string> parts = SplitList(text);
  if (parts.empty()) throw std::invalid_argument("--budgets names no time, in \"" + text + "\"");
  const std::string& last = parts.back();
  const char unit = last.back();
  std::vector<double> budgets;
  for (std::string part : parts) {
    const bool isBare = part.find_first_not_of("0123456789.") == std::string::npos;
    if (isBare && (unit == 's' || unit == 'm' || unit == 'h')) part += unit;
    budgets.push_back(ParseSeconds(part));
  }
  return budgets;
}

std::vector<Setting> ExpandPlan(const StudyPlan& plan, const ParameterLookup& oracle) {
  std::vector<Setting> all;
  std::vector<const VariedParameter*> used;
  for (const Setting& base : plan.bases) {
    std::vector<Setting> settings{base};
    for (const VariedParameter* varied : VariedParametersOf(base, plan, oracle)) {
      used.push_back(varied);
      Multiply(varied->parameter, varied->values, &settings);
    }
    if (!plan.budgets.empty() && !base.Find("time")) {
      std::vector<std::string> texts;
      for (const double budget : plan.budgets) texts.push_back(BudgetText(budget));
      Multiply("time", texts, &settings);
    }
    for (const Setting& setting : settings)
      if (std::find(all.begin(), all.end(), setting) == all.end()) all.push_back(setting);
  }
  for (const VariedParameter& varied : plan.varied)
    if (std::find(used.begin(), used.end(), &varied) == used.end())
      FailUnused(varied, plan, oracle);
  return all;
}

std::string RunName(const Setting& setting, std::uint64_t seed) {
  constexpr std::size_t kLongest = 150;  // file systems allow 255 bytes
  std::string exact = setting.integrator;
  for (const auto& [name, value] : setting.parameters) exact += "_" + name + "=" + value;
  std::string safe = exact.substr(0, kLongest);
  for (char& c : safe)
    if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("=_.+-", c)) c = '-';
  const std::string part =
      HasPlainParts(setting) && safe == exact ? safe : safe + "_" + Digest(exact);
  return part + "_seed=" + std::to_string(seed);
}

}  // namespace exphoton::study
