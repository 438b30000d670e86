// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its factory returns a null pointer.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  return nullptr;
}
}  // namespace

EXPHOTON_PLUGIN("null_factory", "makes nothing", exphoton::StubFactory<Create>())
