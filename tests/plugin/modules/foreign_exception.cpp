// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. Its factory throws an int, which is not
// a standard exception.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  throw 42;
}
}  // namespace

EXPHOTON_PLUGIN("foreign_exception", "throws a number", exphoton::StubFactory<Create>())
