// SPDX-License-Identifier: BSD-2-Clause
// StubFilter is a minimal filter. The faulty plugins of the loader's tests share it through this
// header. A real plugin needs no header.
#pragma once

#include "core/plugin.h"

namespace exphoton {
namespace {

struct StubSettings {
  Real width = 1;
};

inline const ParamTable<StubSettings>& StubParameters() {
  static const ParamTable<StubSettings> table{
      Param("width", &StubSettings::width, "half of the width").Above(0)};
  return table;
}

class StubFilter final : public Filter {
 public:
  Real XWidth() const override { return 1; }
  Real YWidth() const override { return 1; }
  Real Evaluate(Point2) const override { return 1; }
  FilterSample Sample(Point2) const override { return {}; }
};

template <auto create>
PluginFactory StubFactory() {
  return MakeFactory<PluginKind::Filter, create>(StubParameters());
}

}  // namespace
}  // namespace exphoton
