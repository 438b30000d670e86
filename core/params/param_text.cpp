// SPDX-License-Identifier: BSD-2-Clause
// Formats the types, ranges and numbers of declarations for messages, listings and the reference.
#include "core/params/param_text.h"

#include <charconv>
#include <cmath>

#include "core/params/param_table.h"

namespace exphoton {

const char* ParamTypeName(ParamType type) {
  switch (type) {
    case ParamType::Integer:
      return "integer";
    case ParamType::Float:
      return "float";
    case ParamType::Bool:
      return "bool";
    case ParamType::String:
      return "string";
    case ParamType::Choice:
      return "string";
    case ParamType::File:
      return "string";
    case ParamType::Color:
      return "color";
    case ParamType::Point:
      return "point";
    case ParamType::Vector:
      return "vector";
    case ParamType::Normal:
      return "normal";
    case ParamType::FloatTexture:
      return "float texture";
    case ParamType::ColorTexture:
      return "color texture";
    case ParamType::IntegerList:
      return "integer list";
    case ParamType::FloatList:
      return "float list";
    case ParamType::PointList:
      return "point list";
    case ParamType::VectorList:
      return "vector list";
    case ParamType::NormalList:
      return "normal list";
    case ParamType::Point2List:
      return "point2 list";
  }
  return "";
}

std::string NumberText(double v) {
  if (std::isnan(v)) return "nan";
  if (std::isinf(v)) return v > 0 ? "infinity" : "-infinity";
  if (v == std::trunc(v) && std::abs(v) < 1e10) return std::to_string(static_cast<long long>(v));
  char text[40];
  const float narrow = static_cast<float>(v);
  const bool isNarrow = static_cast<double>(narrow) == v;
  // The shortest digits that parse to this value, as a float if it is one: "0.1".
  const std::to_chars_result result = isNarrow ? std::to_chars(text, text + sizeof text, narrow)
                                               : std::to_chars(text, text + sizeof text, v);
  return std::string(text, result.ptr);
}

std::string RangeText(const ParamDecl& decl) {
  if (decl.min && decl.max && !decl.minExcluded && !decl.maxExcluded) {
    return "between " + NumberText(*decl.min) + " and " + NumberText(*decl.max);
  }
  std::string text;
  if (decl.min) text = (decl.minExcluded ? "above " : "at least ") + NumberText(*decl.min);
  if (decl.min && decl.max) text += " and ";
  if (decl.max) text += (decl.maxExcluded ? "below " : "at most ") + NumberText(*decl.max);
  return text;
}

}  // namespace exphoton
