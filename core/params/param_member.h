// SPDX-License-Identifier: BSD-2-Clause
// ParamMember describes how to set a settings member of one C++ type from a scene file and how to
// print it as a default. There is one object per type, compiled once, so that the parameter tables
// of plugins instantiate no conversions.
#pragma once

#include <any>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"
#include "core/params/param_set.h"

namespace exphoton {

enum class ParamType {
  Integer,
  Float,
  Bool,
  String,
  Choice,
  File,
  Color,
  Point,
  Vector,
  Normal,
  FloatTexture,
  ColorTexture,
  IntegerList,
  FloatList,
  PointList,
  VectorList,
  NormalList,
  Point2List,
};
// Returns "integer", "float texture" ...; returns "string" for all types that scene files write as
// a string.
const char* ParamTypeName(ParamType type);

// Members are passed by address, because tables know the type only during their construction.
struct ParamMember {
  ParamType type;
  // The range of integers that the member can hold, within +-2^53. Unused for other types.
  double lowest = 0, highest = 0;
  // Stores a value. The any holds: long long (Integer, Choice), Real, bool, std::string, Spectrum,
  // Vec3, TexturePtr<T> or std::vector<int | Real | Vec3 | Point2>.
  void (*assign)(void* member, const std::any& value) = nullptr;
  // Returns the value in scene file syntax; "" for an std::optional and for lists of points.
  std::string (*text)(const void* member) = nullptr;
  // Returns the number of the enumerator (Choice only).
  long long (*choice)(const void* member) = nullptr;
};

// Returns the conversions of member type T. T may be an std::optional of most of these types. The
// plugin can then see that the file does not set the parameter.
template <class T>
const ParamMember& MemberOf() = delete;  // no parameter type for this member
template <>
const ParamMember& MemberOf<bool>();
template <>
const ParamMember& MemberOf<int>();
template <>
const ParamMember& MemberOf<std::int64_t>();
template <>
const ParamMember& MemberOf<Real>();
template <>
const ParamMember& MemberOf<std::string>();
template <>
const ParamMember& MemberOf<Spectrum>();
template <>
const ParamMember& MemberOf<Vec3>();
template <>
const ParamMember& MemberOf<TexturePtr<Real>>();
template <>
const ParamMember& MemberOf<TexturePtr<Spectrum>>();
template <>
const ParamMember& MemberOf<std::vector<int>>();
template <>
const ParamMember& MemberOf<std::vector<Real>>();
template <>
const ParamMember& MemberOf<std::vector<Vec3>>();
template <>
const ParamMember& MemberOf<std::vector<Point2>>();
template <>
const ParamMember& MemberOf<std::optional<bool>>();
template <>
const ParamMember& MemberOf<std::optional<int>>();
template <>
const ParamMember& MemberOf<std::optional<std::int64_t>>();
template <>
const ParamMember& MemberOf<std::optional<Real>>();
template <>
const ParamMember& MemberOf<std::optional<std::string>>();
template <>
const ParamMember& MemberOf<std::optional<Spectrum>>();
template <>
const ParamMember& MemberOf<std::optional<Vec3>>();
template <>
const ParamMember& MemberOf<std::optional<std::vector<Real>>>();

// An enumeration. The any holds the number of the enumerator.
template <class T>
requires std::is_enum_v<T>
const ParamMember& MemberOf() {
  static constexpr ParamMember kMember{
      .type = ParamType::Choice,
      .assign =
          [](void* member, const std::any& value) {
            *static_cast<T*>(member) = static_cast<T>(std::any_cast<long long>(value));
          },
      .choice =
          [](const void* member) {
            return static_cast<long long>(*static_cast<const T*>(member));
          }};
  return kMember;
}

}  // namespace exphoton
