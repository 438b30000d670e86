// SPDX-License-Identifier: BSD-2-Clause
// A faulty plugin for the loader's tests: its factory throws what is no exception.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  throw 42;
}
}  // namespace

EXPHOTON_PLUGIN("foreign_exception", "throws a number", exphoton::StubForm(Create))
