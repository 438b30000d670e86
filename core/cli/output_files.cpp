// SPDX-License-Identifier: BSD-2-Clause
// Output paths: what is checked is done, not guessed: a temporary file is made and removed again.
#include "core/cli/output_files.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/base/error.h"
#include "core/files/atomic_file.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailWrite(const std::string& path, const std::string& why) {
  throw Error(ExitStatus::File, "cannot write \"" + path + "\": " + why);
}

}  // namespace

std::string ResolveOutput(const std::string& path) {
  std::error_code error;
  if (!fs::is_symlink(path, error) || error) return path;
  const fs::path target = fs::weakly_canonical(path, error);
  if (error) FailWrite(path, "the link leads nowhere");
  if (!fs::is_symlink(target, error)) return target.string();
  // A dangling link: its folder may exist all the same.
  const fs::path next = fs::read_symlink(path, error);
  return (next.is_absolute() ? next : fs::path(path).parent_path() / next).string();
}

void CheckWritable(const std::string& path) {
  if (path.empty()) throw Error(ExitStatus::File, "the output file has no name");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) FailWrite(path, "is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) FailWrite(path, "is not a regular file");
  if (fs::exists(status) && access(path.c_str(), W_OK) != 0) FailWrite(path, std::strerror(errno));
  const AtomicFile probe(path);
}

void MakeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw Error(ExitStatus::File, "cannot make the folder \"" + path + "\": " + error.message());
}

std::string PartialName(const std::string& path) {
  const fs::path file(path);
  if (file.extension() != ".exr") return path + ".partial.exr";
  fs::path partial = file;
  partial.replace_extension(".partial.exr");
  return partial.string();
}

void WriteTextFile(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.Write(text.data(), text.size());
  file.Commit();
}

void PrintOut(const std::string& text) {
  errno = 0;
  const bool isWritten = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!isWritten || std::fflush(stdout) != 0)
    FailWrite("<stdout>", errno ? std::strerror(errno) : "write error");
}

}  // namespace exphoton::cli
