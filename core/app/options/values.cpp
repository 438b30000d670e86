// SPDX-License-Identifier: BSD-2-Clause
// This file parses comma-separated numbers, durations, AOV names and --set.
#include "core/app/options/values.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "core/base/error.h"
#include "core/base/format.h"
#include "core/params/suggestions.h"
#include "core/parser/film_parameters.h"

namespace exphoton::cli {
namespace {

// Parses exactly `count` numbers, or throws a usage error.
template <class T>
std::vector<T> ParseList(const std::string& option, const std::string& text, std::size_t count,
                         const std::string& form) {
  std::vector<T> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end) {
    if (*at == '+' || *at == ' ') {
      ++at;
      continue;
    }
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || (next != end && *next != ',')) break;
    values.push_back(value);
    if (next == end) {
      at = end;
      break;
    }
    at = next + 1;
    if (at == end) break;  // trailing comma
  }
  const bool isWhole = at == end && !text.empty() && text.back() != ',';
  if (!isWhole || values.size() != count)
    FailUsage(option + " takes " + form + ", not \"" + text + "\"");
  return values;
}

}  // namespace

void FailUsage(const std::string& text, const std::string& hint) {
  throw Error(ExitStatus::CommandLine, text, SourceLocation(), hint);
}

std::vector<Real> ParseCropWindow(const std::string& text, const std::string& option) {
  std::vector<Real> window = ParseList<Real>(option, text, 4, "x0,x1,y0,y1");
  if (const std::string problem = CheckCropWindow(window); !problem.empty())
    FailUsage(option + " " + text + " " + problem);
  return window;
}

PixelBounds ParsePixelBounds(const std::string& text) {
  const std::vector<int> v = ParseList<int>("--pixelbounds", text, 4, "x0,x1,y0,y1 in pixels");
  const PixelBounds bounds{v[0], v[2], v[1], v[3]};
  if (bounds.IsEmpty()) FailUsage("--pixelbounds " + text + " is empty or reversed");
  return bounds;
}

PixelBounds ParsePixel(const std::string& text, const std::string& option) {
  const std::vector<int> v = ParseList<int>(option, text, 2, "x,y");
  if (v[0] < 0 || v[1] < 0 || v[0] >= 1 << 30 || v[1] >= 1 << 30)
    FailUsage(option + " " + text + " lies outside every picture");
  return {v[0], v[1], v[0] + 1, v[1] + 1};
}

void AddResolution(const std::string& text, std::vector<ParameterOverride>* overrides) {
  const std::size_t x = text.find('x');
  const auto isNumber = [](const std::string& part) {
    return !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
  };
  const auto isInRange = [](const std::string& part) {
    return part.size() < 7 && part.find_first_not_of('0') != std::string::npos;
  };
  if (x == std::string::npos || !isNumber(text.substr(0, x)) || !isNumber(text.substr(x + 1)))
    FailUsage("--resolution takes WIDTHxHEIGHT, for example 128x96, not \"" + text + "\"");
  if (!isInRange(text.substr(0, x)) || !isInRange(text.substr(x + 1)))
    FailUsage("--resolution takes widths and heights from 1 to 999999, not \"" + text + '"');
  overrides->push_back({"Film", "xresolution", text.substr(0, x)});
  overrides->push_back({"Film", "yresolution", text.substr(x + 1)});
}

ParameterOverride ParseOverride(const std::string& text) {
  const std::size_t dot = text.find('.');
  const std::size_t equals = text.find('=');
  if (dot == std::string::npos || equals == std::string::npos || dot == 0 || equals < dot + 2)
    FailUsage("--set takes Directive.parameter=value, not \"" + text + "\"",
              "for example --set SurfaceIntegrator.maxdepth=8");
  return {text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1)};
}

double ParseDuration(const std::string& option, const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  const std::string_view unit(next, std::size_t(end - next));
  const double seconds = unit.empty() || unit == "s" ? 1
                         : unit == "m"               ? 60
                         : unit == "h"               ? 3600
                                                     : 0;
  value *= seconds;
  if (error != std::errc{} || !(value > 0) || !(value < 1e9))
    FailUsage(option + " takes a time such as 90, 90s, 2m or 1h, not \"" + text + "\"");
  return value;
}

double ParsePercentage(const std::string& option, const std::string& text) {
  double value = 0;
  const auto [next, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view unit(next, std::size_t(text.data() + text.size() - next));
  if (error != std::errc{} || unit != "%" || !(value >= kLeastPercentage && value <= 100))
    FailUsage(option + Format(" takes percentages from %g to 100, not ", kLeastPercentage) + '"' +
                  text + '"',
              "for example 2%");
  return value / 100;
}

std::string AllAovNames() {
  AovSet all;
  for (int i = 0; i < kAovCount; ++i) all.Add(Aov(i));
  return all.Names() + ", light (all light AOVs), cryptomatte (both crypto AOVs)";
}

Shard ParseShard(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = [&](std::size_t begin, std::size_t end) {
    const std::string digits = text.substr(begin, end - begin);
    const bool isNumber = !digits.empty() && digits.size() < 10 &&
                          digits.find_first_not_of("0123456789") == std::string::npos;
    return isNumber ? std::stoi(digits) : 0;
  };
  Shard shard{0, 0};
  if (slash != std::string::npos) shard = {number(0, slash), number(slash + 1, text.size())};
  if (shard.index < 1 || shard.count > Shard::kMaxCount || shard.index > shard.count)
    FailUsage("--shard takes I/N with 1 <= I <= N <= " + std::to_string(Shard::kMaxCount) +
                  ", not \"" + text + '"',
              "--shard 3/16 renders the third of 16 shares");
  return shard;
}

AovSet ParseAovList(const std::string& text) {
  std::string unknown;
  if (const auto aovs = ParseAovs(text, &unknown)) return *aovs;
  std::vector<std::string> names{"light", "cryptomatte"};
  for (int i = 0; i < kAovCount; ++i) names.emplace_back(GetAovInfo(Aov(i)).name);
  FailUsage("--aov: unknown AOV \"" + unknown + "\"; AOVs are " + AllAovNames(),
            DidYouMean(unknown, names));
}

}  // namespace exphoton::cli
