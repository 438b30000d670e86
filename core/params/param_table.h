// SPDX-License-Identifier: BSD-2-Clause
// ParamTable: the parameters a plugin declares, once, as data: name, member of a settings struct
// (whose initialiser is the default), range, unit and meaning. From it come validation, error
// messages, the listing of `exphoton plugins`, the generated reference and the extreme-value tests.
//
//   struct Settings { int maxDepth = 5; std::optional<Real> maxDist; };
//   const ParamTable<Settings>& Parameters() {
//     static const ParamTable<Settings> table{
//         Param("maxdepth", &Settings::maxDepth, "specular bounces followed").Range(0, 1000),
//         Param("maxdist", &Settings::maxDist, "search radius; chosen if absent")
//             .Above(0).Unit("scene units")};
//     return table;
//   }
#pragma once

#include <algorithm>
#include <any>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/math/spectrum.h"
#include "core/math/vec.h"
#include "core/params/param_set.h"

namespace exphoton {

class Log;

// Thrown by Settings::Validate() or a factory: a rule that one parameter breaks. The binder adds the
// place of that parameter (of the directive where the file does not give it).
struct ParamError {
  std::string param;
  std::string text;  // "must be at most 'zmax'"
  std::string hint;
};

enum class ParamType {
  Integer, Float, Bool, String, Choice, File, Color, Point, Vector, Normal,
  FloatTexture, ColorTexture,
  IntegerList, FloatList, PointList, VectorList, NormalList, Point2List,
};
// "integer", "float texture" ...; "string" where a scene file writes one, whatever it means.
const char* ParamTypeName(ParamType type);

// One declared parameter, type-erased.
struct ParamDecl {
  std::string name, doc, unit;
  ParamType type = ParamType::Float;
  std::optional<double> min, max;  // of each number
  bool minExcluded = false, maxExcluded = false;
  bool isRequired = false;
  // What an Integer's member can hold, within +-2^53.
  double lowest = std::numeric_limits<int>::lowest(), highest = std::numeric_limits<int>::max();
  std::vector<std::string> choices;  // of a Choice, and of nothing else
  std::string defaultText;           // as a scene file would write it; "" where automatic
};
// "between 0 and 90", "above 0 and at most 1"; "" without limits.
std::string RangeText(const ParamDecl& decl);

// Everything binding needs besides the values.
struct BindContext {
  const TextureLookup* textures = nullptr;  // null: no texture parameters here
  Log* log = nullptr;
  bool isStrict = false;
  std::string what;  // "integrator \"exphotonmap\"": for messages
  // Parameter names of other plugins of the same kind: naming one is only a notice. Asked when an
  // unknown name is met. May be empty.
  std::function<std::vector<std::string>()> siblingNames;
  // A second set that overrides and need not be consumed (a shape's, over its material's).
  const ParamSet* overrides = nullptr;
};

// The untyped half: declarations, and assignment of checked values through std::any.
class ParamTableBase {
 public:
  virtual ~ParamTableBase() = default;
  const std::vector<ParamDecl>& Declarations() const { return declarations_; }

 protected:
  // Checks types, counts, ranges and names; for each declared parameter present in the file calls
  // set(index, value). Throws Error(Scene) with file, line, column and hint.
  // Values: long long, Real, bool, std::string (Choice: its index as int), Spectrum, Vec3,
  // TexturePtr<T>, std::vector<int | Real | Vec3 | Point2>.
  void BindValues(const ParamSet& params, const BindContext& context,
                  const std::function<void(std::size_t index, std::any value)>& set) const;
  // Turns a ParamError into an Error at the parameter's place.
  [[noreturn]] static void Locate(const ParamError& error, const ParamSet& params,
                                  const BindContext& context);

  std::vector<ParamDecl> declarations_;
};

namespace detail {

template <class T>
struct StripOptional {
  using Type = T;
};
template <class T>
struct StripOptional<std::optional<T>> {
  using Type = T;
};

template <class T>
constexpr ParamType TypeOf() {
  using V = typename StripOptional<T>::Type;
  if constexpr (std::is_same_v<V, bool>) return ParamType::Bool;
  else if constexpr (std::is_enum_v<V>) return ParamType::Choice;
  else if constexpr (std::is_integral_v<V>) return ParamType::Integer;
  else if constexpr (std::is_floating_point_v<V>) return ParamType::Float;
  else if constexpr (std::is_same_v<V, std::string>) return ParamType::String;
  else if constexpr (std::is_same_v<V, Spectrum>) return ParamType::Color;
  else if constexpr (std::is_same_v<V, Vec3>) return ParamType::Point;
  else if constexpr (std::is_same_v<V, TexturePtr<Real>>) return ParamType::FloatTexture;
  else if constexpr (std::is_same_v<V, TexturePtr<Spectrum>>) return ParamType::ColorTexture;
  else if constexpr (std::is_same_v<V, std::vector<int>>) return ParamType::IntegerList;
  else if constexpr (std::is_same_v<V, std::vector<Real>>) return ParamType::FloatList;
  else if constexpr (std::is_same_v<V, std::vector<Vec3>>) return ParamType::PointList;
  else if constexpr (std::is_same_v<V, std::vector<Point2>>) return ParamType::Point2List;
  else static_assert(!sizeof(V), "no parameter type for this member");
}

// Text of a default value, as a scene file would write it.
std::string DefaultText(bool v);
std::string DefaultText(long long v);
std::string DefaultText(double v);
std::string DefaultText(const std::string& v);
std::string DefaultText(const Spectrum& v);
std::string DefaultText(const Vec3& v);
std::string DefaultText(const std::vector<Real>& v);
// The value of a UniformTexture; "" for a null texture.
std::string DefaultText(const TexturePtr<Real>& v);
std::string DefaultText(const TexturePtr<Spectrum>& v);

}  // namespace detail

// One parameter of settings struct S, stored in a member of type T. T may be std::optional<U>: then
// absence stays visible. Integers are 32-bit in files; a 64-bit member accepts up to 2^53.
template <class S, class T>
class Param {
 public:
  using Value = typename detail::StripOptional<T>::Type;

  Param(std::string name, T S::*member, std::string doc) : member_(member) {
    decl_.name = std::move(name);
    decl_.doc = std::move(doc);
    decl_.type = detail::TypeOf<T>();
    if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
      constexpr double kExact = 9007199254740992.0;  // 2^53
      decl_.lowest = std::max(double(std::numeric_limits<Value>::lowest()), -kExact);
      decl_.highest = std::min(double(std::numeric_limits<Value>::max()), kExact);
    }
  }
  Param& Range(double min, double max) { decl_.min = min, decl_.max = max; return *this; }
  Param& AtLeast(double min) { decl_.min = min; return *this; }
  Param& AtMost(double max) { decl_.max = max; return *this; }
  Param& Above(double min) { decl_.min = min; decl_.minExcluded = true; return *this; }
  Param& Below(double max) { decl_.max = max; decl_.maxExcluded = true; return *this; }
  Param& Unit(std::string unit) { decl_.unit = std::move(unit); return *this; }
  Param& Required() { decl_.isRequired = true; return *this; }
  // A Vec3 member that is a vector or normal; a string member that names a file.
  Param& As(ParamType type) { decl_.type = type; return *this; }
  // For enum members: the names in the scene file.
  Param& OneOf(std::vector<std::pair<std::string, Value>> choices) {
    for (auto& [text, value] : choices) {
      decl_.choices.push_back(text);
      values_.push_back(value);
    }
    return *this;
  }

 private:
  template <class>
  friend class ParamTable;

  std::string DefaultOf(const S& defaults) const {
    const T& value = defaults.*member_;
    if constexpr (!std::is_same_v<T, Value>) {
      (void)value;
      return "";
    } else if constexpr (std::is_enum_v<T>) {
      for (std::size_t i = 0; i < values_.size(); ++i)
        if (values_[i] == value) return detail::DefaultText(decl_.choices[i]);
      return "";
    } else if constexpr (std::is_same_v<T, bool>) {
      return detail::DefaultText(value);
    } else if constexpr (std::is_integral_v<T>) {
      return detail::DefaultText(static_cast<long long>(value));
    } else if constexpr (std::is_floating_point_v<T>) {
      return detail::DefaultText(static_cast<double>(value));
    } else if constexpr (requires { detail::DefaultText(value); }) {
      return detail::DefaultText(value);
    } else {
      return "";
    }
  }
  void Assign(S& settings, const std::any& value) const {
    if constexpr (std::is_enum_v<Value>) {
      settings.*member_ = values_[std::size_t(std::any_cast<int>(value))];
    } else if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>) {
      settings.*member_ = static_cast<Value>(std::any_cast<long long>(value));
    } else {
      settings.*member_ = std::any_cast<const Value&>(value);
    }
  }

  T S::*member_;
  ParamDecl decl_;
  std::vector<Value> values_;  // of the choices
};
template <class S, class T>
Param(const char*, T S::*, const char*) -> Param<S, T>;

template <class S>
class ParamTable final : public ParamTableBase {
 public:
  template <class... T>
  ParamTable(const Param<S, T>&... params) {
    [[maybe_unused]] const S defaults{};
    (AddOne(params, defaults), ...);
  }
  // A table that begins with the entries of a base struct's table: shared declarations, whose
  // defaults are those of S.
  template <class Base, class... T>
  ParamTable(const ParamTable<Base>& base, const Param<S, T>&... params) {
    static_assert(std::is_base_of_v<Base, S>);
    [[maybe_unused]] const S defaults{};
    for (std::size_t i = 0; i < base.Declarations().size(); ++i) {
      declarations_.push_back(base.Declarations()[i]);
      declarations_.back().defaultText = base.DefaultTextAt(i, defaults);
      assign_.push_back([&base, i](S& s, const std::any& v) { base.AssignAt(i, s, v); });
      defaultText_.push_back([&base, i](const S& s) { return base.DefaultTextAt(i, s); });
    }
    (AddOne(params, defaults), ...);
  }

  // The settings that this set of parameters means. Calls S::Validate() const if there is one, which
  // may throw ParamError.
  S Bind(const ParamSet& params, const BindContext& context) const {
    S settings{};
    BindValues(params, context, [&](std::size_t index, std::any value) {
      assign_[index](settings, value);
    });
    if constexpr (requires { settings.Validate(); }) {
      try {
        settings.Validate();
      } catch (const ParamError& error) {
        Locate(error, params, context);
      }
    }
    return settings;
  }
  // Runs a factory whose ParamErrors get their place.
  template <class F>
  auto Guard(const ParamSet& params, const BindContext& context, F&& factory) const {
    try {
      return factory();
    } catch (const ParamError& error) {
      Locate(error, params, context);
    }
  }
  void AssignAt(std::size_t index, S& settings, const std::any& value) const {
    assign_[index](settings, value);
  }
  std::string DefaultTextAt(std::size_t index, const S& settings) const {
    return defaultText_[index](settings);
  }

 private:
  template <class T>
  void AddOne(const Param<S, T>& param, const S& defaults) {
    declarations_.push_back(param.decl_);
    declarations_.back().defaultText = param.DefaultOf(defaults);
    assign_.push_back([param](S& s, const std::any& v) { param.Assign(s, v); });
    defaultText_.push_back([param](const S& s) { return param.DefaultOf(s); });
  }

  std::vector<std::function<void(S&, const std::any&)>> assign_;
  std::vector<std::function<std::string(const S&)>> defaultText_;
};

}  // namespace exphoton
