// SPDX-License-Identifier: BSD-2-Clause
// CheckWritable tries to write: it makes a temporary file and removes it again.
#include "core/app/output/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>

#include "core/app/process/temporary_folder.h"
#include "core/base/error.h"
#include "core/files/atomic_file.h"
#include "core/files/file_identity.h"

namespace exphoton::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailWrite(const std::string& path, const std::string& why) {
  throw Error(ExitStatus::File, "cannot write \"" + path + "\": " + why);
}

// In a folder with the sticky bit, such as /tmp, only the owner of the file or of the folder may
// replace a file.
bool MayReplace(const std::string& path) {
  const std::string target = FollowLinks(path);
  struct stat file, folder;
  if (geteuid() == 0 || stat(target.c_str(), &file) != 0 ||
      stat(FolderOf(target).c_str(), &folder) != 0)
    return true;
  return !(folder.st_mode & S_ISVTX) || file.st_uid == geteuid() || folder.st_uid == geteuid();
}

}  // namespace

void CheckWritable(const std::string& path) {
  if (path.empty()) throw Error(ExitStatus::File, "the output file has no name");
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) FailWrite(path, "is a directory");
  if (fs::exists(status) && !fs::is_regular_file(status)) FailWrite(path, "is not a regular file");
  if (fs::exists(status) && access(path.c_str(), W_OK) != 0) FailWrite(path, std::strerror(errno));
  if (fs::exists(status) && !MayReplace(path))
    FailWrite(path, "in this folder only its owner may replace it");
  const AtomicFile probe(path);
}

void MakeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error)
    throw Error(ExitStatus::File, "cannot make the folder \"" + path + "\": " + error.message());
}

void WriteTextFile(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.Write(text.data(), text.size());
  file.Commit();
}

void WriteOrKeepElsewhere(const std::string& path,
                          const std::function<void(const std::string&)>& write) {
  std::optional<Error> failure;
  try {
    write(path);
  } catch (const Error& error) {
    if (error.Status() != ExitStatus::File) throw;
    failure = error;
  }
  if (!failure) return;
  std::string other;
  try {
    TemporaryFolder folder("kept");
    other = folder.File(fs::path(path).filename());
    write(other);
    folder.Keep();
  } catch (const std::exception&) {
    throw *failure;
  }
  throw Error(ExitStatus::File,
              std::string(failure->what()) + "; it is written to \"" + other + "\" instead", {},
              "move it from there, because temporary folders are emptied");
}

void PrintOut(const std::string& text) {
  errno = 0;
  const bool isWritten = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!isWritten || std::fflush(stdout) != 0)
    FailWrite("<stdout>", errno ? std::strerror(errno) : "write error");
}

}  // namespace exphoton::cli
