// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its descriptor has another name
// than its file.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  return std::make_unique<exphoton::StubFilter>();
}
}  // namespace

EXPHOTON_PLUGIN("rightly_named", "has two names", exphoton::StubFactory<Create>())
