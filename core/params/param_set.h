// SPDX-License-Identifier: BSD-2-Clause
// ParamSet holds the parameters of one directive, as written in the scene file, with their
// locations. A plugin's ParamTable interprets them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/scattering/texture.h"

namespace exphoton {

struct ParsedParam {
  std::string type;  // as written: "float", "rgb", "texture" ...
  std::string name;
  std::vector<double> numbers;             // for numeric types
  std::vector<std::string> strings;        // for string, bool, texture, or spectrum files
  SourceLocation where;                    // location of the declaration
  std::vector<SourceLocation> valueWhere;  // empty, or one location per value (short lists only)
};

class ParamSet {
 public:
  // Adds a parameter. A later parameter replaces an earlier one of the same name; the caller warns.
  void Add(ParsedParam param);
  const ParsedParam* Find(const std::string& name) const;
  const std::vector<ParsedParam>& All() const { return params_; }
  bool IsEmpty() const { return params_.empty(); }

  SourceLocation where;  // location of the directive

 private:
  std::vector<ParsedParam> params_;
};

// Finds the named textures that "texture" parameters refer to. Returns null for an unknown name.
class TextureLookup {
 public:
  virtual ~TextureLookup() = default;
  virtual TexturePtr<Real> Float(const std::string& name) const = 0;
  virtual TexturePtr<Spectrum> Color(const std::string& name) const = 0;
  virtual std::vector<std::string> Names() const = 0;  // for "did you mean"
};

}  // namespace exphoton
