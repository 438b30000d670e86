// SPDX-License-Identifier: BSD-2-Clause
// StateWriter and StateFile write and read the state of a stopped render: named sections of bytes
// between a signature and a checksum. docs/development/state-files.md describes the format. The
// sections themselves belong to the classes that they are named after.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "core/files/atomic_file.h"
#include "core/files/byte_archive.h"

namespace exphoton {

inline constexpr std::uint32_t kStateVersion = 1;

// Writes a file that appears under its name only with Commit. Errors throw Error(File).
class StateWriter {
 public:
  explicit StateWriter(const std::string& path);
  void Add(std::string_view name, std::string_view bytes);
  void Commit();

 private:
  void Write(const void* data, std::size_t size);

  AtomicFile file_;
  std::uint64_t checksum_ = 0;
};

class StateFile {
 public:
  // Reads a whole file and checks it. Errors throw Error(File): the text says whether the file is
  // of another kind, of another version, cut off or damaged.
  explicit StateFile(const std::string& path);

  const std::string& Path() const { return path_; }
  void Release() { bytes_ = {}, sections_.clear(); }  // frees the memory
  bool Has(const std::string& name) const { return sections_.contains(name); }
  // Returns the bytes of a section. Throws Error(File) if it is missing.
  std::string_view Get(const std::string& name) const;
  // Loads a section. A section that does not fit throws Error(File).
  template <class Load>
  void Read(const std::string& name, const Load& load) const;

 private:
  [[noreturn]] void Fail(const std::string& why) const;

  std::string path_, bytes_;
  std::map<std::string, std::string_view> sections_;
};

// Returns whether the file begins with the signature of a state.
bool IsStateFile(const std::string& path);

// The checksum of some bytes that follow bytes with the checksum `before`. A change of any single
// byte changes it.
std::uint64_t StateChecksum(std::uint64_t before, std::string_view bytes);

template <class Load>
void StateFile::Read(const std::string& name, const Load& load) const {
  try {
    ByteArchive archive(Get(name));
    load(&archive);
    archive.CheckEnd();
  } catch (const ArchiveError& error) {
    Fail("its section \"" + name + "\" does not fit this render: " + error.what());
  }
}

}  // namespace exphoton
