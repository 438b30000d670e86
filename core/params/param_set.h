// SPDX-License-Identifier: BSD-2-Clause
// ParamSet: the parameters of one directive as the scene file wrote them, with their places. What
// they mean is decided by a plugin's ParamTable.
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
  std::vector<double> numbers;             // of a numeric type
  std::vector<std::string> strings;        // of string, bool, texture or spectrum files
  SourceLocation where;                    // of the declaration
  std::vector<SourceLocation> valueWhere;  // sparse: empty, or one a value (short lists only)
};

class ParamSet {
 public:
  // A repeated name: the later one wins; the caller warns.
  void Add(ParsedParam param);
  const ParsedParam* Find(const std::string& name) const;
  const std::vector<ParsedParam>& All() const { return params_; }
  bool IsEmpty() const { return params_.empty(); }

  SourceLocation where;  // of the directive

 private:
  std::vector<ParsedParam> params_;
};

// Named textures that "texture" parameters refer to; null where there is no such name.
class TextureLookup {
 public:
  virtual ~TextureLookup() = default;
  virtual TexturePtr<Real> Float(const std::string& name) const = 0;
  virtual TexturePtr<Spectrum> Color(const std::string& name) const = 0;
  virtual std::vector<std::string> Names() const = 0;  // for "did you mean"
};

}  // namespace exphoton
