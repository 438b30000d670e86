// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its factory throws a standard exception.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  throw std::runtime_error("out of filters");
}
}  // namespace

EXPHOTON_PLUGIN("throwing_factory", "throws", exphoton::StubFactory<Create>())
