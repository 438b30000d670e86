// SPDX-License-Identifier: BSD-2-Clause
// This library is not a plugin. Its static initialiser creates a file, so that tests can find out
// whether the library's code has run.
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
