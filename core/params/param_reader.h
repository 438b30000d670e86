// SPDX-License-Identifier: BSD-2-Clause
// ParamReader converts one parameter of a scene file to the type of its declaration. Errors state
// the location of the wrong value. It does not consider other parameters.
#pragma once

#include <any>
#include <string>
#include <string_view>
#include <vector>

#include "core/params/param_table.h"

namespace exphoton {

class ParamReader {
 public:
  ParamReader(const ParamDecl& decl, const ParsedParam& param, const BindContext& context)
      : decl_(decl), param_(param), context_(context) {}

  // Returns the value in the form that ParamMember::assign expects, but a Choice as the int index
  // of the choice. Throws Error(Scene).
  std::any Read() const;
  // Returns whether the declaration accepts the type that the file states.
  bool HasAcceptedType() const;

 private:
  std::any ReadInteger() const;
  std::any ReadString() const;
  std::any ReadChoice() const;
  Spectrum ReadColor() const;
  template <class T>
  std::any ReadTexture() const;
  template <class V, int kSize>
  std::vector<V> ReadTuples() const;
  std::vector<Real> ReadFloats() const;
  std::vector<int> ReadIntegers() const;

  // Returns the textures that the parameter can name; null if it can name none.
  const TextureLookup* Textures() const;

  // Colours before the range check.
  Spectrum ColorFromFile() const;
  Spectrum ColorFromPairs() const;
  Spectrum ColorOfBlackbody() const;
  Spectrum KeepInGamut(Spectrum color, const std::vector<double>& from) const;

  // Checks. `index` is the index of the value to check.
  void NeedType() const;
  void NeedCount(std::size_t count) const;
  void NeedRange(double number, std::size_t index) const;
  long long NeedInteger(std::size_t index) const;
  Real NeedReal(std::size_t index) const;

  const SourceLocation& Place(std::size_t index) const {
    return index < param_.valueWhere.size() ? param_.valueWhere[index] : param_.where;
  }
  // Throws the error `parameter "fov" of camera "perspective" ` + rest.
  [[noreturn]] void Fail(const std::string& rest, const SourceLocation& where,
                         const std::string& hint = {}) const;
  std::string Subject() const;
  std::string TriedPaths() const;  // of a file name

  const ParamDecl& decl_;
  const ParsedParam& param_;
  const BindContext& context_;
};

// Returns the scene file types that a declared type accepts, the usual type first: "color", "rgb"
// ...
std::vector<std::string_view> AcceptedTypes(ParamType type);

}  // namespace exphoton
