// SPDX-License-Identifier: BSD-2-Clause
// ParamMember: the conversions of every member type that a settings struct may have.
#include "core/params/param_member.h"

#include <algorithm>
#include <limits>

#include "core/params/param_text.h"

namespace exphoton {
namespace {

template <class T>
struct WithoutOptional {
  using Type = T;
};
template <class T>
struct WithoutOptional<std::optional<T>> {
  using Type = T;
};

template <class V>
constexpr ParamType TypeOf() {
  if constexpr (std::is_same_v<V, bool>)
    return ParamType::Bool;
  else if constexpr (std::is_integral_v<V>)
    return ParamType::Integer;
  else if constexpr (std::is_floating_point_v<V>)
    return ParamType::Float;
  else if constexpr (std::is_same_v<V, std::string>)
    return ParamType::String;
  else if constexpr (std::is_same_v<V, Spectrum>)
    return ParamType::Color;
  else if constexpr (std::is_same_v<V, Vec3>)
    return ParamType::Point;
  else if constexpr (std::is_same_v<V, TexturePtr<Real>>)
    return ParamType::FloatTexture;
  else if constexpr (std::is_same_v<V, TexturePtr<Spectrum>>)
    return ParamType::ColorTexture;
  else if constexpr (std::is_same_v<V, std::vector<int>>)
    return ParamType::IntegerList;
  else if constexpr (std::is_same_v<V, std::vector<Real>>)
    return ParamType::FloatList;
  else if constexpr (std::is_same_v<V, std::vector<Vec3>>)
    return ParamType::PointList;
  else if constexpr (std::is_same_v<V, std::vector<Point2>>)
    return ParamType::Point2List;
}

template <class V>
constexpr bool kIsInteger = std::is_integral_v<V> && !std::is_same_v<V, bool>;

template <class T>
void Assign(void* member, const std::any& value) {
  using V = typename WithoutOptional<T>::Type;
  T& target = *static_cast<T*>(member);
  if constexpr (kIsInteger<V>) {
    target = static_cast<V>(std::any_cast<long long>(value));
  } else {
    target = std::any_cast<const V&>(value);
  }
}

std::string TextOf(bool v) { return v ? "\"true\"" : "\"false\""; }
std::string TextOf(std::int64_t v) { return std::to_string(v); }
std::string TextOf(double v) { return NumberText(v); }
std::string TextOf(const std::string& v) { return '"' + v + '"'; }
std::string TextOf(const Spectrum& v) {
  return '[' + NumberText(double(v.r)) + ' ' + NumberText(double(v.g)) + ' ' +
         NumberText(double(v.b)) + ']';
}
std::string TextOf(const Vec3& v) {
  return '[' + NumberText(double(v.x)) + ' ' + NumberText(double(v.y)) + ' ' +
         NumberText(double(v.z)) + ']';
}
std::string TextOf(const std::vector<Real>& v) {
  if (v.empty()) return "";
  std::string text;
  for (const Real number : v) text += ' ' + NumberText(double(number));
  return '[' + text.substr(1) + ']';
}
// Returns the value of a constant texture; "" for a null or non-constant texture.
template <class V>
std::string TextOf(const TexturePtr<V>& v) {
  const std::optional<V> value = v ? v->ConstantValue() : std::nullopt;
  if (!value) return "";
  if constexpr (std::is_same_v<V, Spectrum>)
    return TextOf(*value);
  else
    return TextOf(double(*value));
}

template <class T>
std::string Text(const void* member) {
  const T& value = *static_cast<const T*>(member);
  if constexpr (kIsInteger<T>)
    return TextOf(std::int64_t(value));
  else if constexpr (std::is_floating_point_v<T>)
    return TextOf(double(value));
  else if constexpr (requires { TextOf(value); })
    return TextOf(value);
  else
    return "";
}

// Limits the range of an integer member to the integers that a double represents exactly.
template <class V>
constexpr double Limit(V limit) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  return std::clamp(double(limit), -kExact, kExact);
}

template <class T>
constexpr ParamMember Describe() {
  using V = typename WithoutOptional<T>::Type;
  ParamMember member{.type = TypeOf<V>(), .assign = &Assign<T>, .text = &Text<T>};
  if constexpr (kIsInteger<V>) {
    member.lowest = Limit(std::numeric_limits<V>::lowest());
    member.highest = Limit(std::numeric_limits<V>::max());
  }
  return member;
}

}  // namespace

template <>
const ParamMember& MemberOf<bool>() {
  static constexpr ParamMember kMember = Describe<bool>();
  return kMember;
}
template <>
const ParamMember& MemberOf<int>() {
  static constexpr ParamMember kMember = Describe<int>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::int64_t>() {
  static constexpr ParamMember kMember = Describe<std::int64_t>();
  return kMember;
}
template <>
const ParamMember& MemberOf<Real>() {
  static constexpr ParamMember kMember = Describe<Real>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::string>() {
  static constexpr ParamMember kMember = Describe<std::string>();
  return kMember;
}
template <>
const ParamMember& MemberOf<Spectrum>() {
  static constexpr ParamMember kMember = Describe<Spectrum>();
  return kMember;
}
template <>
const ParamMember& MemberOf<Vec3>() {
  static constexpr ParamMember kMember = Describe<Vec3>();
  return kMember;
}
template <>
const ParamMember& MemberOf<TexturePtr<Real>>() {
  static constexpr ParamMember kMember = Describe<TexturePtr<Real>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<TexturePtr<Spectrum>>() {
  static constexpr ParamMember kMember = Describe<TexturePtr<Spectrum>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::vector<int>>() {
  static constexpr ParamMember kMember = Describe<std::vector<int>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::vector<Real>>() {
  static constexpr ParamMember kMember = Describe<std::vector<Real>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::vector<Vec3>>() {
  static constexpr ParamMember kMember = Describe<std::vector<Vec3>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::vector<Point2>>() {
  static constexpr ParamMember kMember = Describe<std::vector<Point2>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<bool>>() {
  static constexpr ParamMember kMember = Describe<std::optional<bool>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<int>>() {
  static constexpr ParamMember kMember = Describe<std::optional<int>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<std::int64_t>>() {
  static constexpr ParamMember kMember = Describe<std::optional<std::int64_t>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<Real>>() {
  static constexpr ParamMember kMember = Describe<std::optional<Real>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<std::string>>() {
  static constexpr ParamMember kMember = Describe<std::optional<std::string>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<Spectrum>>() {
  static constexpr ParamMember kMember = Describe<std::optional<Spectrum>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<Vec3>>() {
  static constexpr ParamMember kMember = Describe<std::optional<Vec3>>();
  return kMember;
}
template <>
const ParamMember& MemberOf<std::optional<std::vector<Real>>>() {
  static constexpr ParamMember kMember = Describe<std::optional<std::vector<Real>>>();
  return kMember;
}

}  // namespace exphoton
