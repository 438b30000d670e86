// SPDX-License-Identifier: BSD-2-Clause
// GuardedCall is the outermost exception handler of the program.
#include "core/app/options/errors.h"

#include <cstdio>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/app/options/option_parser.h"
#include "core/app/output/output_files.h"
#include "core/app/process/signals.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/terminal.h"
#include "core/imaging/image.h"
#include "core/parser/render_setup.h"

namespace exphoton::cli {
namespace {

int Fail(ExitStatus status, const std::string& text,
         const std::optional<SourceLocation>& where = {}, const std::string& hint = {}) {
  const std::string message = FormatDiagnostic("error", text, where, hint);
  const std::string shown = (IsRedrawable() ? "\r\x1b[K" : "") + Colored(message, "error");
  std::fwrite(shown.data(), 1, shown.size(), stderr);
  return int(status);
}

// Must not allocate memory: a failure here could no longer be reported.
int FailWithoutMemory() {
  if (IsRedrawable()) std::fputs("\r\x1b[K", stderr);
  std::fputs("exphoton: error: ", stderr);
  std::fputs(OutOfMemoryText(), stderr);
  std::fputs("\n", stderr);
  return int(ExitStatus::Resource);
}

int FailBySystem(ExitStatus status, const std::string& text, const std::error_code& code) {
  if (code == std::errc::not_enough_memory) throw std::bad_alloc();
  return Fail(status, text);
}

std::string FileSystemText(const std::filesystem::filesystem_error& error) {
  const std::string path = error.path1().string();
  return "cannot use " + (path.empty() ? "a file or folder" : '"' + path + '"') + ": " +
         error.code().message();
}

// Handles all exceptions except std::bad_alloc, which it passes on. Formatting a message can throw
// std::bad_alloc, too.
int Try(void (*work)(const void*), const void* context) {
  try {
    work(context);
    return 0;
  } catch (const TextRequest& request) {
    return Guarded([&request] { PrintOut(request.text); });
  } catch (const LoadingStopped&) {
    std::fputs("exphoton: interrupted before anything was rendered\n", stderr);
    return 128 + SignalNumber();
  } catch (const Error& error) {
    const int status = Fail(error.Status(), error.what(), error.Where(), error.Hint());
    for (const Error& other : error.Others())
      Fail(other.Status(), other.what(), other.Where(), other.Hint());
    return status;
  } catch (const ImageError& error) {
    return Fail(ExitStatus::File, error.what());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::length_error&) {
    return Fail(ExitStatus::Resource, "out of memory: a size is larger than the address space");
  } catch (const std::filesystem::filesystem_error& error) {
    return FailBySystem(ExitStatus::File, FileSystemText(error), error.code());
  } catch (const std::system_error& error) {
    return FailBySystem(ExitStatus::Resource, error.what(), error.code());
  } catch (const std::exception& error) {
    return Fail(ExitStatus::Internal, std::string("internal error: ") + error.what());
  } catch (...) {
    return Fail(ExitStatus::Internal, "internal error of an unknown kind");
  }
}

}  // namespace

int GuardedCall(void (*work)(const void*), const void* context) {
  try {
    return Try(work, context);
  } catch (const std::bad_alloc&) {
    return FailWithoutMemory();
  }
}

}  // namespace exphoton::cli
