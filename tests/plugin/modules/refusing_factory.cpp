// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests works, but its factory refuses a parameter value of more
// than 2 with a ParamError.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings& settings,
                                         const exphoton::NoContext&) {
  if (settings.width > 2) throw exphoton::ParamError{"width", "is too wide for me", "try 2"};
  return std::make_unique<exphoton::StubFilter>();
}
}  // namespace

EXPHOTON_PLUGIN("refusing_factory", "refuses", exphoton::StubFactory<Create>())
