// SPDX-License-Identifier: BSD-2-Clause
// ParameterStrips lists the pictures of the reference pages that show what a parameter does.
#pragma once

#include <span>
#include <string>

#include "core/plugins/kinds.h"

namespace exphoton {

// A strip of small pictures, one for each value of a parameter.
// docs/reference/images/make_strips.py renders it.
struct ParameterStrip {
  PluginKind kind;
  const char *plugin, *parameter;
  // As in the script: semicolons separate values that have spaces, and spaces separate others.
  const char* values;

  std::string Page() const;  // "materials.md"
  std::string Name() const;  // "materials/matte-sigma"
};
std::span<const ParameterStrip> ParameterStrips();

}  // namespace exphoton
