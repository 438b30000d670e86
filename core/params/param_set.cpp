// SPDX-License-Identifier: BSD-2-Clause
// ParamSet: the list of parameters of a directive.
#include "core/params/param_set.h"

#include <algorithm>
#include <utility>

namespace exphoton {

void ParamSet::Add(ParsedParam param) {
  std::erase_if(params_, [&](const ParsedParam& other) { return other.name == param.name; });
  params_.push_back(std::move(param));
}

const ParsedParam* ParamSet::Find(const std::string& name) const {
  const auto found = std::find_if(params_.begin(), params_.end(),
                                  [&](const ParsedParam& param) { return param.name == name; });
  return found == params_.end() ? nullptr : &*found;
}

}  // namespace exphoton
