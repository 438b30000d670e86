// SPDX-License-Identifier: BSD-2-Clause
// FileIdentity identifies the file that a path names, however the path is spelt: through symbolic
// links, hard links, "..", relative or absolute. No file is opened.
#pragma once

#include <sys/types.h>

#include <compare>
#include <optional>
#include <string>

namespace exphoton {

// FileIdentity is the device and inode of an existing file. For a missing file it is the device and
// inode of the folder, and the name there.
struct FileIdentity {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name;
  auto operator<=>(const FileIdentity&) const = default;
};

// Identifies the file at `path`. Returns nullopt if not even its folder exists.
std::optional<FileIdentity> IdentifyFile(const std::string& path);
// Identifies the regular file behind an open descriptor. Returns nullopt for anything else, such
// as pipes and terminals.
std::optional<FileIdentity> IdentifyOpenFile(int descriptor);

// Returns the path at the end of a chain of symbolic links. The end need not exist. For a loop,
// returns one of its links.
std::string FollowLinks(const std::string& path);

std::string FolderOf(const std::string& path);  // "." for a bare name
std::string NameOf(const std::string& path);    // "" for a path that ends in a slash

// Returns whether `path` is `folder` or lies below it. Symbolic links in both are followed. Returns
// false if `folder`, or the folder that contains `path`, does not exist.
bool LiesIn(const std::string& path, const std::string& folder);

}  // namespace exphoton
