// SPDX-License-Identifier: BSD-2-Clause
// File identities come from stat. Symbolic links are followed by hand, because realpath fails if
// the last link is dangling.
#include "core/files/file_identity.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace exphoton {
namespace {

namespace fs = std::filesystem;
constexpr int kMaxLinks = 40;  // the kernel's limit

std::string ReadLink(const std::string& path) {
  std::vector<char> text(256);
  for (;;) {
    const ssize_t size = readlink(path.c_str(), text.data(), text.size());
    if (size < 0) return "";
    if (std::size_t(size) < text.size()) return {text.data(), std::size_t(size)};
    text.resize(2 * text.size());
  }
}

bool IsWithin(const fs::path& path, const fs::path& folder) {
  auto part = path.begin();
  for (auto step = folder.begin(); step != folder.end(); ++step, ++part)
    if (part == path.end() || *part != *step) return false;
  return true;
}

}  // namespace

std::string FolderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return path.substr(0, std::max<std::size_t>(slash, 1));
}

std::string NameOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string FollowLinks(const std::string& path) {
  std::string at = path;
  for (int i = 0; i <= kMaxLinks; ++i) {
    struct stat status;
    if (lstat(at.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return at;
    const std::string next = ReadLink(at);
    if (next.empty()) return at;
    at = next[0] == '/' ? next : FolderOf(at) + "/" + next;
  }
  return at;
}

std::optional<FileIdentity> IdentifyFile(const std::string& path) {
  struct stat status;
  if (stat(path.c_str(), &status) == 0) return FileIdentity{status.st_dev, status.st_ino, ""};
  const std::string target = FollowLinks(path);
  if (stat(FolderOf(target).c_str(), &status) != 0) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, NameOf(target)};
}

std::optional<FileIdentity> IdentifyOpenFile(int descriptor) {
  struct stat status;
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileIdentity{status.st_dev, status.st_ino, ""};
}

bool LiesIn(const std::string& path, const std::string& folder) {
  std::error_code error;
  const fs::path outer = fs::canonical(folder, error);
  if (error) return false;
  const std::string target = FollowLinks(path);
  fs::path inner = fs::canonical(target, error);
  if (error) inner = fs::canonical(FolderOf(target), error);
  return !error && IsWithin(inner, outer);
}

}  // namespace exphoton
