// SPDX-License-Identifier: BSD-2-Clause
// ParamTable declares the parameters of a plugin as data: name, member of a settings struct (whose
// initialiser is the default), range, unit and meaning. Validation, error messages, the listing of
// `exphoton plugins`, the generated reference and the extreme-value tests all use this table.
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

#include <any>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/params/param_member.h"
#include "core/params/param_set.h"

namespace exphoton {

class Log;

// Dialect is the version of the scene language. It selects the meaning of LookAt (version 2 mirrors
// the view) and the defaults of some parameters.
enum class Dialect { V1, V2 };

// An error in one parameter, thrown by Settings::Validate() or a factory. The binder adds the
// location of the parameter, or the location of the directive if the file does not set the
// parameter.
struct ParamError {
  std::string param;
  std::string text;  // for example "must be at most 'zmax'"
  std::string hint;
};

// A declared parameter.
struct ParamDecl {
  std::string name, doc, unit;
  ParamType type = ParamType::Float;
  std::optional<double> min, max;  // limits of each number
  bool minExcluded = false, maxExcluded = false;
  bool isRequired = false;
  // The range that an Integer's member can hold, within +-2^53.
  double lowest = std::numeric_limits<int>::lowest(), highest = std::numeric_limits<int>::max();
  std::vector<std::string> choices;  // Choice only
  std::string defaultText;           // in scene file syntax; "" if automatic
  int quickDivisor = 1;              // --quick divides the value by this
  bool isBasic = false;              // among the few that most scenes need
  bool isIgnored = false;            // accepted for other programs' scenes; has no effect
  // The default in scenes of version 2, as numbers; empty if it is the same.
  std::vector<double> version2Default;
  // The default where the command line names the integrator, as a number; absent if it is the same.
  std::optional<double> namedDefault;
};
// A parameter that an earlier version of the plugin had. A scene that gives it is an error,
// whatever the value, because its picture could differ from the one that its author saw.
struct RemovedParam {
  std::string name;
  std::string replacement;  // the plugin's present behaviour, as a clause
  std::string hint;         // how to change the scene
};
// Returns "between 0 and 90", "above 0 and at most 1" ...; "" without limits.
std::string RangeText(const ParamDecl& decl);

// The data that binding needs besides the parameter values.
struct BindContext {
  const TextureLookup* textures = nullptr;  // null: texture parameters are not allowed
  Log* log = nullptr;
  bool isStrict = false;
  Dialect dialect = Dialect::V1;
  std::string what;  // for messages, such as "integrator \"exphotonmap\""
  // Returns the parameter names of other plugins of the same kind. Such a name causes a notice
  // instead of a warning. Called when an unknown name is found. May be empty.
  std::function<std::vector<std::string>()> siblingNames;
  // A second set whose parameters override the first (a shape's parameters override those of its
  // material). Unknown names in this set are not reported.
  const ParamSet* overrides = nullptr;
  const TextureLookup* overrideTextures = nullptr;  // as `textures`, for the second set
};

// A parameter during its declaration, without the types of the settings struct and the member.
struct ParamDraft {
  ParamDraft(const char* name, const ParamMember& member, const char* doc);
  ~ParamDraft();

  ParamDecl decl;
  const ParamMember* member;
  std::vector<long long> choiceValues;  // the enumerators' numbers, in the order of decl.choices
};

// The untyped half of a table: the declarations, and the assignment of checked values to members by
// their offset.
class ParamTableBase {
 public:
  virtual ~ParamTableBase();
  const std::vector<ParamDecl>& Declarations() const { return declarations_; }
  // Throws the ParamError as an Error with the location of the parameter.
  [[noreturn]] void Locate(const ParamError& error, const ParamSet& params,
                           const BindContext& context) const;
  // Throws Error(Scene) with this location if an earlier version of the plugin had this parameter.
  // `what` names the plugin in the message.
  void RefuseRemoved(const std::string& name, const std::string& what,
                     const SourceLocation& where) const;

 protected:
  // Declares a parameter whose member has this offset in the settings. `defaults` is a
  // default-initialised settings struct.
  void Add(const ParamDraft& draft, const void* defaults, std::ptrdiff_t offset);
  // Declares the parameters of a base struct that has this offset in the settings.
  void AddBase(const ParamTableBase& base, const void* defaults, std::ptrdiff_t offset);
  void AddRemoved(const std::vector<RemovedParam>& removed);
  // Checks types, counts, ranges and names. Stores each declared parameter that the file sets in
  // `settings`. Throws Error(Scene) with file, line, column and hint.
  void BindValues(const ParamSet& params, const BindContext& context, void* settings) const;

 private:
  struct Slot {
    std::ptrdiff_t offset;
    const ParamMember* member;
    std::vector<long long> choiceValues;
  };
  std::string MissingFileHint(const ParsedParam& param) const;
  void AddSlot(ParamDecl decl, Slot slot, const void* defaults);
  // Reads the parameter of declaration i and stores it.
  void Assign(std::size_t i, const ParsedParam& param, const BindContext& context,
              void* settings) const;

  std::vector<ParamDecl> declarations_;
  std::vector<Slot> slots_;  // in the order of declarations_
  std::vector<RemovedParam> removed_;
};

// A parameter of settings struct S that is stored in a member of type T. T may be std::optional<U>,
// so that the plugin can see whether the file sets the parameter. Integers have 32 bits in files; a
// 64-bit member accepts up to 2^53.
template <class S, class T>
class Param : public ParamDraft {
 public:
  struct Choice {
    const char* name;
    T value;
  };

  Param(const char* name, T S::*member, const char* doc)
      : ParamDraft(name, MemberOf<T>(), doc), member_(member) {}

  Param& Range(double min, double max) {
    decl.min = min, decl.max = max;
    return *this;
  }
  Param& AtLeast(double min) {
    decl.min = min;
    return *this;
  }
  Param& AtMost(double max) {
    decl.max = max;
    return *this;
  }
  Param& Above(double min) {
    decl.min = min;
    decl.minExcluded = true;
    return *this;
  }
  Param& Below(double max) {
    decl.max = max;
    decl.maxExcluded = true;
    return *this;
  }
  Param& Unit(const char* unit) {
    decl.unit = unit;
    return *this;
  }
  Param& InVersion2(std::vector<double> numbers) {
    decl.version2Default = std::move(numbers);
    return *this;
  }
  Param& Required() {
    decl.isRequired = true;
    return *this;
  }
  // Integrators only: the default where the command line names the integrator.
  Param& WhenNamed(double number) {
    decl.namedDefault = number;
    return *this;
  }
  // The parameter is checked but has no effect. The text says why.
  Param& Ignored() {
    decl.isIgnored = true;
    return *this;
  }
  // Most scenes need only the basic parameters of a plugin. The reference lists them first. A
  // plugin without basic parameters has one list.
  Param& Basic() {
    decl.isBasic = true;
    return *this;
  }
  // For the counts of an integrator: --quick divides the value of the file, or the default, by
  // this.
  Param& DividedByQuick(int divisor) {
    decl.quickDivisor = divisor;
    return *this;
  }
  // For a Vec3 member that is a vector or normal, or a string member that names a file.
  Param& As(ParamType type) {
    decl.type = type;
    return *this;
  }
  // For enum members: the names in the scene file.
  Param& OneOf(std::initializer_list<Choice> choices) {
    for (const Choice& choice : choices) {
      decl.choices.push_back(choice.name);
      choiceValues.push_back(static_cast<long long>(choice.value));
    }
    return *this;
  }
  const void* MemberIn(const S& settings) const { return &(settings.*member_); }

 private:
  T S::*member_;
};
template <class S, class T>
Param(const char*, T S::*, const char*) -> Param<S, T>;

template <class S>
class ParamTable final : public ParamTableBase {
 public:
  template <class... T>
  ParamTable(const Param<S, T>&... params) {
    [[maybe_unused]] const S defaults{};
    (AddOne(params, defaults, params.MemberIn(defaults)), ...);
  }
  // A table of a plugin that had more parameters in earlier versions.
  template <class... T>
  ParamTable(const std::vector<RemovedParam>& removed, const Param<S, T>&... params)
      : ParamTable(params...) {
    AddRemoved(removed);
  }
  // A table that begins with the entries of a base struct's table. The declarations are shared; the
  // defaults come from S.
  template <class Base, class... T>
  ParamTable(const ParamTable<Base>& base, const Param<S, T>&... params) {
    static_assert(std::is_base_of_v<Base, S>);
    const S defaults{};
    AddBase(base, &defaults, Offset(defaults, static_cast<const Base*>(&defaults)));
    (AddOne(params, defaults, params.MemberIn(defaults)), ...);
  }

  // Returns the settings that the parameters describe. Calls S::Validate() const if it exists,
  // which may throw ParamError.
  S Bind(const ParamSet& params, const BindContext& context) const {
    S settings{};
    BindValues(params, context, &settings);
    if constexpr (requires { settings.Validate(); }) {
      try {
        settings.Validate();
      } catch (const ParamError& error) {
        Locate(error, params, context);
      }
    }
    return settings;
  }

 private:
  static std::ptrdiff_t Offset(const S& settings, const void* part) {
    return static_cast<const char*>(part) - reinterpret_cast<const char*>(&settings);
  }
  void AddOne(const ParamDraft& draft, const S& defaults, const void* member) {
    Add(draft, &defaults, Offset(defaults, member));
  }
};

}  // namespace exphoton
