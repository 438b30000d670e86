// SPDX-License-Identifier: BSD-2-Clause
// ParamReader: turns what a scene file wrote for one parameter into the value that its declaration
// asks for, or says at the place of the value why it cannot. Knows nothing of other parameters.
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

  // A value as ParamTableBase::BindValues passes it on. Throws Error(Scene).
  std::any Read() const;

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

  // Colours before the check of their range.
  Spectrum ColorFromFile() const;
  Spectrum ColorFromPairs() const;
  Spectrum ColorOfBlackbody() const;
  Spectrum KeepInGamut(Spectrum color, const std::vector<double>& from) const;

  // Checks; `index` is of the value that is at fault.
  void NeedType() const;
  void NeedCount(std::size_t count) const;
  void NeedRange(double number, std::size_t index) const;
  long long NeedInteger(std::size_t index) const;
  Real NeedReal(std::size_t index) const;

  const SourceLocation& Place(std::size_t index) const {
    return index < param_.valueWhere.size() ? param_.valueWhere[index] : param_.where;
  }
  // `parameter "fov" of camera "perspective" ` + rest
  [[noreturn]] void Fail(const std::string& rest, const SourceLocation& where,
                         const std::string& hint = {}) const;
  std::string Subject() const;

  const ParamDecl& decl_;
  const ParsedParam& param_;
  const BindContext& context_;
};

// The types in a scene file that a declared type accepts, the usual one first: "color", "rgb" ...
std::vector<std::string_view> AcceptedTypes(ParamType type);

}  // namespace exphoton
