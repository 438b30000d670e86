// SPDX-License-Identifier: BSD-2-Clause
// Which file a path names, however it is spelt: through links, hard links, "..", relative or
// absolute. Nothing is opened.
#pragma once

#include <sys/types.h>

#include <compare>
#include <optional>
#include <string>

namespace exphoton {

// Of a file that exists: its device and inode. Of one that does not: those of its folder, and its
// name there.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name;
  auto operator<=>(const FileIdentity&) const = default;
};

// Nothing where not even the folder exists.
std::optional<FileIdentity> IdentifyFile(const std::string& path);
// Of a regular file that a descriptor has open; nothing for pipes, terminals and the like.
std::optional<FileIdentity> IdentifyOpenFile(int descriptor);

// The path at the end of a chain of links, which need not exist. Of a loop, one of its links.
std::string FollowLinks(const std::string& path);

std::string FolderOf(const std::string& path);  // "." for a bare name
std::string NameOf(const std::string& path);    // "" for a path that ends in a slash

// Whether the file or folder lies in the folder or below it, or is it. Both are followed through
// links; false where the folder does not exist.
bool LiesIn(const std::string& path, const std::string& folder);

}  // namespace exphoton
