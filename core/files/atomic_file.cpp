// SPDX-License-Identifier: BSD-2-Clause
// AtomicFile uses POSIX calls: it writes beside the target, calls fsync, renames the file and calls
// fsync on the folder. These steps go through one descriptor of the folder, so moving the folder
// meanwhile does no harm.
#include "core/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <new>
#include <system_error>
#include <vector>

#include "core/base/error.h"
#include "core/files/file_identity.h"

namespace exphoton {
namespace {

constexpr mode_t kPermissions = 07777;
constexpr const char* kAccessList = "system.posix_acl_access";

[[noreturn]] void FailAbout(const std::string& what, const std::string& path, int reason) {
  if (reason == ENOMEM) throw std::bad_alloc();
  throw Error(ExitStatus::File, what + " \"" + path + "\": " + std::strerror(reason));
}

[[noreturn]] void FailBecause(const std::string& path, const char* why) {
  throw Error(ExitStatus::File, "cannot write \"" + path + "\": " + why);
}

// Returns the mode of the existing target, or 0 if there is none.
mode_t ModeOfTarget(int folder, const std::string& name, const std::string& path) {
  struct stat status;
  if (fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno == ENOENT) return 0;
    FailAbout("cannot create", path, errno);
  }
  if (S_ISDIR(status.st_mode)) FailBecause(path, "it is a directory");
  if (!S_ISREG(status.st_mode)) FailBecause(path, "it is not an ordinary file");
  return status.st_mode;
}

// Gives the new file the owner and group of the older one and returns its mode. If the system
// refuses the owner, the set-user-ID bit is dropped. If it refuses the group, the set-group-ID bit
// is dropped and the group gets the permissions of others, so that the new group gains no access.
mode_t KeepOwner(int file, const struct stat& older, mode_t mode) {
  struct stat own;
  if (fstat(file, &own) != 0) return mode;
  if (own.st_uid != older.st_uid && fchown(file, older.st_uid, gid_t(-1)) != 0)
    mode &= ~mode_t(S_ISUID);
  if (own.st_gid != older.st_gid && fchown(file, uid_t(-1), older.st_gid) != 0) {
    const mode_t others = mode & 07;
    mode = (mode & ~mode_t(S_ISGID | 070)) | (mode & others << 3);
  }
  return mode;
}

void KeepAccessList(int folder, const std::string& name, int file) {
  const Descriptor older(openat(folder, name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  if (!older.IsOpen()) return;
  const ssize_t size = fgetxattr(older.Get(), kAccessList, nullptr, 0);
  if (size <= 0) return;
  std::vector<char> list(std::size_t(size), '\0');
  if (fgetxattr(older.Get(), kAccessList, list.data(), list.size()) == size)
    fsetxattr(file, kAccessList, list.data(), list.size(), 0);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  struct stat status;
  if (stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    FailBecause(path, S_ISDIR(status.st_mode) ? "it is a directory" : "it is not an ordinary file");
  const std::string target = FollowLinks(path);
  const std::string folder = FolderOf(target);
  name_ = NameOf(target);
  if (name_.empty() || name_ == "." || name_ == "..") FailBecause(path, "it is a directory");
  int opened = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0 && errno == EACCES)  // write permission suffices, without list permission
    opened = open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (opened < 0) Fail("cannot create");
  folder_ = std::make_unique<Descriptor>(opened);
  mode_ = ModeOfTarget(opened, name_, path);
  try {
    // If there is an older file, its access may be restricted. Start with owner-only access, so
    // that the new file is never readable by others meanwhile.
    file_ = std::make_unique<TemporaryFile>(opened, name_, mode_ ? 0600 : 0666);
  } catch (const std::system_error& error) {
    errno = error.code().value();
    Fail("cannot create");
  }
  stream_ = fdopen(file_->Descriptor(), "wb");
  if (stream_) return;
  const int reason = errno;
  close(file_->Descriptor());
  errno = reason;
  Fail("cannot create");
}

AtomicFile::~AtomicFile() {
  if (stream_) std::fclose(stream_);
}

void AtomicFile::Fail(const std::string& what) {
  if (failure_ == 0) failure_ = errno;
  FailAbout(what, path_, failure_);
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

void AtomicFile::KeepAttributes() {
  const int file = fileno(stream_);
  struct stat older;
  if (fstatat(folder_->Get(), name_.c_str(), &older, AT_SYMLINK_NOFOLLOW) == 0 &&
      S_ISREG(older.st_mode)) {
    const mode_t mode = KeepOwner(file, older, older.st_mode & kPermissions);
    fchmod(file, mode);
    KeepAccessList(folder_->Get(), name_, file);
  } else if (mode_) {  // the older file was removed meanwhile
    fchmod(file, mode_ & kPermissions);
  }
}

void AtomicFile::Commit() {
  if (failure_ != 0 || std::fflush(stream_) != 0 || std::ferror(stream_)) Fail("cannot write");
  KeepAttributes();
  if (fsync(fileno(stream_)) != 0 && errno != EINVAL) Fail("cannot write");
  std::FILE* const stream = stream_;
  stream_ = nullptr;
  if (std::fclose(stream) != 0 || !file_->Rename(name_)) {
    const int reason = errno;
    file_->Remove();
    errno = reason;
    Fail("cannot write");
  }
  // Some file systems do not support fsync of a folder, nor does a folder that was opened without
  // list permission. Only EIO is an error.
  if (fsync(folder_->Get()) != 0 && errno == EIO) Fail("cannot write");
}

}  // namespace exphoton
