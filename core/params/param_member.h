// SPDX-License-Identifier: BSD-2-Clause
// ParamMember: how a settings member of one C++ type is filled from a scene file and printed as a
// default. There is one for each type, compiled once, so that the tables of plugins instantiate no
// conversions of their own.
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
// "integer", "float texture" ...; "string" where a scene file writes one, whatever it means.
const char* ParamTypeName(ParamType type);

// A member is passed by address, because tables know its type only while they are constructed.
struct ParamMember {
  ParamType type;
  // The integers that the member can hold, within +-2^53. Unused for other types.
  double lowest = 0, highest = 0;
  // Stores a value. The any holds: long long (Integer, Choice), Real, bool, std::string, Spectrum,
  // Vec3, TexturePtr<T> or std::vector<int | Real | Vec3 | Point2>.
  void (*assign)(void* member, const std::any& value) = nullptr;
  // The value as a scene file would write it; "" for an std::optional and for lists of points.
  std::string (*text)(const void* member) = nullptr;
  // The enumerator's number (Choice only).
  long long (*choice)(const void* member) = nullptr;
};

// The conversions of member type T. T may be an std::optional of most of these types: then the
// plugin can see that the file does not give the parameter.
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

// An enumeration: the any holds the number of the enumerator.
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
