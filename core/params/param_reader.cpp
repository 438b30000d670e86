// SPDX-License-Identifier: BSD-2-Clause
// ParamReader for numbers, strings, choices and lists. param_color.cpp reads colours and textures.
#include "core/params/param_reader.h"

#include <algorithm>
#include <cmath>

#include "core/params/param_text.h"
#include "core/params/scene_path.h"
#include "core/params/suggestions.h"

namespace exphoton {
namespace {

std::string Quoted(const std::string& text) { return '"' + text + '"'; }

template <class T>
std::string JoinQuoted(const std::vector<T>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += Quoted(std::string(words[i]));
  }
  return text;
}

}  // namespace

std::vector<std::string_view> AcceptedTypes(ParamType type) {
  switch (type) {
    case ParamType::Integer:
    case ParamType::IntegerList:
      return {"integer", "float"};
    case ParamType::Float:
    case ParamType::FloatList:
      return {"float", "integer"};
    case ParamType::Bool:
      return {"bool"};
    case ParamType::String:
    case ParamType::Choice:
    case ParamType::File:
      return {"string"};
    case ParamType::Color:
      return {"color", "rgb", "xyz", "blackbody", "spectrum"};
    case ParamType::Point:
    case ParamType::PointList:
      return {"point", "point3"};
    case ParamType::Vector:
    case ParamType::VectorList:
      return {"vector", "vector3"};
    case ParamType::Normal:
    case ParamType::NormalList:
      return {"normal", "normal3"};
    case ParamType::FloatTexture:
      return {"float", "integer", "texture"};
    case ParamType::ColorTexture:
      return {"color", "rgb", "xyz", "blackbody", "spectrum", "texture"};
    case ParamType::Point2List:
      return {"float", "point2", "integer"};
  }
  return {};
}

bool ParamReader::HasAcceptedType() const {
  const std::vector<std::string_view> accepted = AcceptedTypes(decl_.type);
  return std::find(accepted.begin(), accepted.end(), param_.type) != accepted.end();
}

std::any ParamReader::Read() const {
  NeedType();
  switch (decl_.type) {
    case ParamType::Integer:
      return ReadInteger();
    case ParamType::Float:
      NeedCount(1);
      return NeedReal(0);
    case ParamType::Bool:
    case ParamType::String:
    case ParamType::File:
      return ReadString();
    case ParamType::Choice:
      return ReadChoice();
    case ParamType::Color:
      return ReadColor();
    case ParamType::Point:
    case ParamType::Vector:
    case ParamType::Normal:
      NeedCount(3);
      return ReadTuples<Vec3, 3>()[0];
    case ParamType::FloatTexture:
      return ReadTexture<Real>();
    case ParamType::ColorTexture:
      return ReadTexture<Spectrum>();
    case ParamType::IntegerList:
      return ReadIntegers();
    case ParamType::FloatList:
      return ReadFloats();
    case ParamType::PointList:
    case ParamType::VectorList:
    case ParamType::NormalList:
      return ReadTuples<Vec3, 3>();
    case ParamType::Point2List:
      return ReadTuples<Point2, 2>();
  }
  return {};
}

std::any ParamReader::ReadInteger() const {
  NeedCount(1);
  const long long value = NeedInteger(0);
  return value;
}

std::any ParamReader::ReadString() const {
  NeedCount(1);
  const std::string& text = param_.strings[0];
  if (decl_.type == ParamType::Bool) {
    if (text == "true") return true;
    if (text == "false") return false;
    Fail("must be \"true\" or \"false\", not " + Quoted(text), Place(0));
  }
  if (decl_.type == ParamType::File && !text.empty()) return ResolveScenePath(text, param_.where);
  return text;
}

std::any ParamReader::ReadChoice() const {
  NeedCount(1);
  const std::string& text = param_.strings[0];
  const auto found = std::find(decl_.choices.begin(), decl_.choices.end(), text);
  if (found == decl_.choices.end()) {
    Fail("must be " + JoinQuoted(decl_.choices) + ", not " + Quoted(text), Place(0),
         DidYouMean(text, decl_.choices));
  }
  return int(found - decl_.choices.begin());
}

std::vector<Real> ParamReader::ReadFloats() const {
  std::vector<Real> values(param_.numbers.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = NeedReal(i);
  return values;
}

std::vector<int> ParamReader::ReadIntegers() const {
  std::vector<int> values(param_.numbers.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = int(NeedInteger(i));
  return values;
}

template <class V, int kSize>
std::vector<V> ParamReader::ReadTuples() const {
  if (param_.numbers.size() % kSize != 0) {
    Fail("needs a multiple of " + std::to_string(kSize) + " numbers, not " +
             std::to_string(param_.numbers.size()),
         param_.where);
  }
  std::vector<V> values(param_.numbers.size() / kSize);
  for (std::size_t i = 0; i < param_.numbers.size(); ++i) {
    values[i / kSize][int(i % kSize)] = NeedReal(i);
  }
  return values;
}

void ParamReader::NeedType() const {
  if (!HasAcceptedType()) {
    const std::vector<std::string_view> accepted = AcceptedTypes(decl_.type);
    Fail("must be of type " + JoinQuoted(accepted) + ", not " + Quoted(param_.type), param_.where,
         "write \"" + std::string(accepted[0]) + ' ' + decl_.name + '"');
  }
  if (param_.type == "spectrum") return;  // numbers, or the name of a file
  const bool isText = param_.type == "string" || param_.type == "bool" || param_.type == "texture";
  if (isText && !param_.numbers.empty()) Fail("takes strings in quotes, not numbers", Place(0));
  if (!isText && !param_.strings.empty()) Fail("takes numbers, not strings", Place(0));
}

void ParamReader::NeedCount(std::size_t count) const {
  const std::size_t given = param_.numbers.size() + param_.strings.size();
  if (given == count) return;
  const std::string needed = count == 1 ? "exactly one value" : std::to_string(count) + " values";
  Fail("needs " + needed + ", not " + std::to_string(given), param_.where);
}

void ParamReader::NeedRange(double number, std::size_t index) const {
  // An excluded bound is compared after rounding to Real, because the renderer uses the rounded
  // value.
  const double rounded = double(Real(number));
  const bool isBelow = decl_.min && (decl_.minExcluded ? !(rounded > double(Real(*decl_.min)))
                                                       : number < *decl_.min);
  const bool isAbove = decl_.max && (decl_.maxExcluded ? !(rounded < double(Real(*decl_.max)))
                                                       : number > *decl_.max);
  if (isBelow || isAbove) {
    Fail("must be " + RangeText(decl_) + ", not " + NumberText(number), Place(index));
  }
}

long long ParamReader::NeedInteger(std::size_t index) const {
  const double number = param_.numbers[index];
  if (!std::isfinite(number) || number != std::trunc(number)) {
    Fail("must be an integer, not " + NumberText(number), Place(index));
  }
  NeedRange(number, index);
  if (number < decl_.lowest || number > decl_.highest) {
    Fail("must be between " + std::to_string(static_cast<long long>(decl_.lowest)) + " and " +
             std::to_string(static_cast<long long>(decl_.highest)) + ", not " + NumberText(number),
         Place(index));
  }
  return static_cast<long long>(number);
}

Real ParamReader::NeedReal(std::size_t index) const {
  const double number = param_.numbers[index];
  if (!std::isfinite(number)) {
    Fail("must be a finite number, not " + NumberText(number), Place(index));
  }
  NeedRange(number, index);
  if (!std::isfinite(Real(number))) {
    Fail("must be at most " + NumberText(double(std::numeric_limits<Real>::max())) +
             " in size, not " + NumberText(number),
         Place(index));
  }
  return Real(number);
}

std::string ParamReader::TriedPaths() const {
  return TriedPathsText(
      ScenePathCandidates(param_.strings[0], param_.where.file, MainFileOf(param_.where)));
}

std::string ParamReader::Subject() const {
  return "parameter \"" + decl_.name + "\" of " + context_.what;
}

void ParamReader::Fail(const std::string& rest, const SourceLocation& where,
                       const std::string& hint) const {
  throw Error(ExitStatus::Scene, Subject() + ' ' + rest, where, hint);
}

}  // namespace exphoton
