// SPDX-License-Identifier: BSD-2-Clause
// This plugin works, and creates a file when it is loaded. Tests look for the file to find out
// whether the plugin's code has run.
#include <cstdio>
#include <cstdlib>

#include "tests/plugin/modules/stub_filter.h"

namespace {

const bool hasRun = [] {
  const char* const mark = std::getenv("EXPHOTON_TEST_MARK");
  if (std::FILE* const file = mark ? std::fopen(mark, "w") : nullptr) std::fclose(file);
  return mark != nullptr;
}();

std::unique_ptr<exphoton::Filter> Create(const exphoton::StubSettings&,
                                         const exphoton::NoContext&) {
  static_cast<void>(hasRun);
  return std::make_unique<exphoton::StubFilter>();
}

}  // namespace

EXPHOTON_PLUGIN("marking_filter", "leaves a file when it is loaded",
                exphoton::StubFactory<Create>())
