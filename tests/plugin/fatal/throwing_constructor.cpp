// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests is faulty on purpose. The constructor of a global variable
// throws while the library is loaded.
#include "tests/plugin/modules/stub_filter.h"

namespace {

struct Thrower {
  Thrower() { throw std::runtime_error("no licence"); }
};
Thrower thrower;

std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  return std::make_unique<exphoton::StubFilter>();
}

}  // namespace

EXPHOTON_PLUGIN("throwing_constructor", "throws while it is loaded",
                exphoton::StubFactory<Create>())
