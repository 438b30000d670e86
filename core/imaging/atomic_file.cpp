// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile by POSIX: write beside the target, fsync, rename.
#include "core/imaging/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"

namespace exphoton {
namespace {

// A link is followed, so that the file it names is replaced and not the link.
std::string Resolve(const std::string& path) {
  char* const resolved = realpath(path.c_str(), nullptr);
  if (!resolved) return path;
  std::string result = resolved;
  std::free(resolved);
  return result;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : target_(Resolve(path)) {
  struct stat status;
  if (stat(target_.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) {
    throw Error(ExitStatus::File,
                "cannot write \"" + path + "\": " +
                    (S_ISDIR(status.st_mode) ? "it is a directory" : "it is not an ordinary file"));
  }
  partial_ = target_ + "." + std::to_string(getpid()) + ".partial";
  unlink(partial_.c_str());
  const int descriptor = open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) Fail("cannot create");
  stream_ = fdopen(descriptor, "wb");
  if (!stream_) {
    close(descriptor);
    unlink(partial_.c_str());
    Fail("cannot create");
  }
}

AtomicFile::~AtomicFile() {
  if (!stream_) return;
  std::fclose(stream_);
  unlink(partial_.c_str());
}

void AtomicFile::Fail(const std::string& what) {
  if (failure_ == 0) failure_ = errno;
  throw Error(ExitStatus::File, what + " \"" + target_ + "\": " + std::strerror(failure_));
}

void AtomicFile::Write(const void* data, std::size_t size) {
  if (std::fwrite(data, 1, size, stream_) != size) Fail("cannot write");
}

std::uint64_t AtomicFile::Tell() {
  const off_t position = ftello(stream_);
  if (position < 0) Fail("cannot write");
  return std::uint64_t(position);
}

void AtomicFile::Seek(std::uint64_t position) {
  if (fseeko(stream_, off_t(position), SEEK_SET) != 0) Fail("cannot write");
}

void AtomicFile::Commit() {
  if (failure_ != 0 || std::fflush(stream_) != 0 || std::ferror(stream_)) Fail("cannot write");
  if (fsync(fileno(stream_)) != 0 && errno != EINVAL) Fail("cannot write");
  std::FILE* const stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0 || std::rename(partial_.c_str(), target_.c_str()) != 0) {
    const int reason = errno;
    unlink(partial_.c_str());
    errno = reason;
    Fail("cannot write");
  }
}

}  // namespace exphoton
