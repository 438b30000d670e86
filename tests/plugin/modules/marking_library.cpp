// SPDX-License-Identifier: BSD-2-Clause
// No plugin: a library whose constructor leaves a file, to show that it has run.
#include <cstdio>
#include <cstdlib>

namespace {

const bool hasRun = [] {
  const char* const mark = std::getenv("EXPHOTON_TEST_MARK");
  if (std::FILE* const file = mark ? std::fopen(mark, "w") : nullptr) std::fclose(file);
  return mark != nullptr;
}();

}  // namespace

extern "C" __attribute__((visibility("default"))) bool SomethingElse() { return hasRun; }
