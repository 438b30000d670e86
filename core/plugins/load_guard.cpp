// SPDX-License-Identifier: BSD-2-Clause
// LoadGuard: a terminate handler that reports the library that the thread is loading.
#include "core/plugins/load_guard.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/base/error.h"

namespace exphoton {
namespace {

thread_local const char* loading = nullptr;  // null: this thread loads no library
std::terminate_handler beforeAll = nullptr;

[[noreturn]] void EndTheProgram() {
  if (!loading) {
    if (beforeAll) beforeAll();
    std::abort();
  }
  std::string reason = "an exception";
  try {
    if (const std::exception_ptr exception = std::current_exception())
      std::rethrow_exception(exception);
  } catch (const std::exception& error) {
    reason = error.what();
  } catch (...) {
  }
  std::fprintf(stderr, "exphoton: error: \"%s\" fails while it is loaded, in a constructor: %s\n",
               loading, reason.c_str());
  std::_Exit(int(ExitStatus::Scene));
}

}  // namespace

LoadGuard::LoadGuard(std::string path)
    : path_(std::move(path)), before_(std::set_terminate(EndTheProgram)) {
  if (before_ != EndTheProgram) beforeAll = before_;
  loading = path_.c_str();
}

LoadGuard::~LoadGuard() {
  loading = nullptr;
  std::set_terminate(before_);
}

}  // namespace exphoton
