// SPDX-License-Identifier: BSD-2-Clause
// This plugin for the loader's tests works. It is linked with the older kind of symbol table alone.
#include "tests/plugin/modules/stub_filter.h"

namespace {
std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  return std::make_unique<exphoton::StubFilter>();
}
}  // namespace

EXPHOTON_PLUGIN("old_hash_table", "works", exphoton::StubFactory<Create>())
